#pragma once

#include <bdpt/error.h>
#include <bdpt/fields.h>
#include <bdpt/io/json_value.h>

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bdpt::job {

// Each option of a command is listed once. The parser, the help texts, man pages, completions,
// plans and the Python package are loops over such a list (`OptionList`).

/// Error of an invalid value of an option. main() adds to the message where the command's help is.
class OptionError : public Error {
public:
    explicit OptionError(const std::string& message) : Error(ErrorCode::usage, message) {}
};

/// Error of a name that a file does not have, such as that of a camera.
class UnknownName : public Error {
public:
    explicit UnknownName(const std::string& message) : Error(ErrorCode::not_found, message) {}
};

/// Throws the `OptionError` that names all three: `--spp "VALUE": expected EXPECTED`.
[[noreturn]] void reject(std::string_view option, std::string_view value,
                         std::string_view expected);

/// Type of a value in JSON.
enum class JsonType : std::uint8_t { text, whole_number, number, boolean };

/// Properties of the values of an option, beside their parser.
struct ValueInfo {
    JsonType json = JsonType::text;
    Range range{};                     ///< range of numbers
    std::vector<std::string> words{};  ///< allowed words, if only these are allowed
    bool is_path = false;              ///< a file or folder, unless it is one of `words`
    bool may_be_number = false;        ///< a text that JSON may give as a number
    /// Between several numbers, which may be an array in JSON; 0: a single value.
    char separator = '\0';
    /// Returns the documented spelling of a text that clearly means the same, such as 1000 for 1e3;
    /// any other text unchanged. Null: there is none.
    std::function<std::string(std::string)> respelled{};
};

/// Conversion of a text to a value.
template <typename T>
struct ValueType {
    /// Returns none for an invalid value.
    std::function<std::optional<T>(const std::string&)> parse;
    std::string expected;  ///< description of valid values, as in "expected a number from 0 to 1"
    ValueInfo info{};
};

/// Where an option may be stated. Documents (jobs, plans, scenes of Blender, pickled scenes) may
/// come from anybody: they load no code, connect to no machine and replace no file of others.
enum class StatedIn : std::uint8_t {
    documents,     ///< anywhere
    own_folder,    ///< anywhere; of a document the written file must be in its folder, or below
    programs,      ///< on the command line, and by programs (`RenderJob::set`)
    command_line,  ///< only there
};

/// Uses of an option other than on the command line.
struct OptionUses {
    bool plan_render = false;    ///< plans pass it to `bdpt render`
    bool plan_merge = false;     ///< plans pass it to `bdpt merge`
    bool python_load = false;    ///< keyword of bdpt.load()
    bool python_render = false;  ///< keyword of render() in Python
    bool python_save = false;    ///< keyword of save() in Python
    StatedIn stated_in = StatedIn::documents;
};

/// An option of a command, or a positional argument.
struct Option {
    std::string names;    ///< "-o,--output"; for an argument its word, "file"
    std::string value;    ///< placeholder of its value in the help, "FILE"; empty: a flag
    std::string help;     ///< description of its effect
    std::string section;  ///< title in the help; empty: the parser's default
    OptionUses uses{};
    bool required = false;
    bool repeats = false;  ///< true: all given values count; false: the last one
    /// A flag that is neither on nor off unless it is given, so "false" is a value.
    bool default_is_chosen = false;
    ValueInfo info{};
    /// Parses a text and stores its value. Returns false if the text is not as `expected`.
    std::function<bool(const std::string&)> store;
    std::string expected{};
    std::function<void()> clear{};     ///< clears all values of a repeatable option
    std::vector<std::string> texts{};  ///< the given texts; "true" for a flag
    std::filesystem::path job{};       ///< file of the job that gave them; empty: a person did

    /// Tests whether jobs may state the option.
    [[nodiscard]] bool is_for_jobs() const { return uses.stated_in <= StatedIn::own_folder; }
    /// Tests whether it neither loads code nor names files to write.
    [[nodiscard]] bool is_harmless() const { return uses.stated_in == StatedIn::documents; }
    [[nodiscard]] bool is_flag() const { return value.empty(); }
    [[nodiscard]] bool is_argument() const { return !names.starts_with('-'); }
    /// Returns "--output", or "file" for an argument.
    [[nodiscard]] std::string name() const;
    [[nodiscard]] bool given() const { return !texts.empty(); }
    /// Returns the option with its value as one equivalent word: "--spp=64", "--half".
    [[nodiscard]] std::string word() const;
    /// Returns `text` as documented: with the capital letters of `info.words`, and as
    /// `info.respelled` returns it.
    [[nodiscard]] std::string spelled(std::string text) const;
    /// Returns the value that the invalid `text` probably meant, if any.
    [[nodiscard]] std::optional<std::string> meant(const std::string& text) const;
};

/// The options of a command, in the order of its help, and what was given for them.
class OptionList {
public:
    /// Starts a section of that title for options added from now on.
    void section(std::string title, OptionUses uses = {});

    /// Adds an option that stores the value of its last text into `target`, which outlives the
    /// list.
    template <typename Target, typename T>
    Option& add(std::string names, std::string value, std::string help, Target& target,
                ValueType<T> type)
    {
        Option& option = append(std::move(names), std::move(value), std::move(help));
        option.info = std::move(type.info);
        option.expected = std::move(type.expected);
        option.store = [&target, parse = std::move(type.parse)](const std::string& text) {
            std::optional<T> parsed = parse(text);
            if (parsed) {
                target = static_cast<Target>(std::move(*parsed));
            }
            return parsed.has_value();
        };
        return option;
    }

    /// Adds an option that may be repeated, whose values are appended to `target`.
    template <typename Item, typename T>
    Option& add_repeated(std::string names, std::string value, std::string help,
                         std::vector<Item>& target, ValueType<T> type)
    {
        Option& option = append(std::move(names), std::move(value), std::move(help));
        option.repeats = true;
        option.info = std::move(type.info);
        option.expected = std::move(type.expected);
        option.clear = [&target] { target.clear(); };
        option.store = [&target, parse = std::move(type.parse)](const std::string& text) {
            std::optional<T> parsed = parse(text);
            if (parsed) {
                target.emplace_back(std::move(*parsed));
            }
            return parsed.has_value();
        };
        return option;
    }

    /// Adds a flag, which may also be given as --name=false.
    Option& add_flag(std::string names, std::string help, bool& target);

    /// Adds a flag that may have a value, as --name=VALUE; without one its text is "true".
    template <typename Target, typename T>
    Option& add_flag(std::string names, std::string help, Target& target, ValueType<T> type)
    {
        Option& option = add(std::move(names), "", std::move(help), target, std::move(type));
        option.info.json = JsonType::boolean;
        return option;
    }

    /// Returns the option of that name, such as "--spp", which must exist.
    [[nodiscard]] const Option& at(std::string_view name) const;
    /// Returns the option of that name, or null.
    [[nodiscard]] const Option* find(std::string_view name) const;
    /// Tests whether the option was given. False for one that the command does not have.
    [[nodiscard]] bool given(std::string_view name) const;
    /// Throws the `OptionError` of that option, with the value that was given for it.
    [[noreturn]] void reject_value(std::string_view name, std::string_view expected) const;

    [[nodiscard]] std::deque<Option>& all() { return options_; }
    [[nodiscard]] const std::deque<Option>& all() const { return options_; }

    /// Takes the texts of those options of `other` that are options here, too.
    void take_texts(const OptionList& other);

    /// Stores all given texts, replacing the values stored before. Throws `OptionError` for the
    /// first text that is not as its option expects.
    void store_given();

private:
    Option& append(std::string names, std::string value, std::string help);

    std::deque<Option> options_;  // a deque: options keep their addresses
    std::string section_;
    OptionUses uses_;
};

/// An option that requires another one.
struct Need {
    std::string_view option;
    std::string_view other;  ///< option, or alternatives separated by "|"
    std::string_view why{};  ///< reason, printed after a colon
};

/// Two options that exclude each other.
struct Conflict {
    std::string_view option;
    std::string_view other;
    std::string_view why{};  ///< reason, printed after a colon
};

/// Throws `OptionError` for the first of `needs` that is not met: "--fps needs --frames or
/// --orbit".
void check(std::span<const Need> needs, const OptionList& options);

/// Throws `OptionError` if both are given: "--samples cannot be combined with --spp".
void check(std::span<const Conflict> conflicts, const OptionList& options);

/// What somebody meant who typed an option of another program.
struct ForeignOption {
    std::string_view option;  ///< of ours, "--size"; empty: any command
    std::string_view advice;  ///< what to type
};

/// Returns what `name`, "--width" or "-s", means if another program has it, and the option is one
/// of `options`.
[[nodiscard]] std::optional<ForeignOption> find_foreign(std::string_view name,
                                                        const OptionList& options);

/// Returns the word that `text` was probably meant to be; none if all are far from it.
[[nodiscard]] std::optional<std::string> closest(std::string_view text,
                                                 std::span<const std::string> words);

// A job is a JSON file equivalent to a command line: its members are the options of `bdpt render`
// that documents may state (`StatedIn`), by their names with '_' for '-', and "file", the scene.
// Paths in it are relative to its folder.

/// Value of "bdpt_job" in jobs. It is incremented with every change that older programs would
/// misread.
inline constexpr int job_format = 1;

/// Returns "light_samples" for --light-samples.
[[nodiscard]] std::string to_key(const Option& option);

/// Tests whether `file` is named as a job: .json.
[[nodiscard]] bool is_job(const std::filesystem::path& file);

/// Stores the options of the job in `file` into `options`, except those that were already given;
/// the job replaces the given scene. Throws `Error`: not_found, and invalid_input that names the
/// place in the file.
void load_job(const std::filesystem::path& file, OptionList& options);

/// The same for a job that was read from `file`.
void load_job(const io::JsonValue& job, const std::filesystem::path& file, OptionList& options);

/// Stores `members`, an object of options as in jobs, into `options`, replacing what was given;
/// null removes it. Options of `StatedIn::programs` may be among them; paths are relative to the
/// working directory. Throws `Error` (invalid_input).
void set_options(const io::JsonValue& members, OptionList& options);

/// Returns the given `options` as a job to be written to `file`.
[[nodiscard]] std::string job_text(const OptionList& options, const std::filesystem::path& file);

/// Returns the JSON schema [draft 2020-12] of jobs with `options`.
[[nodiscard]] std::string job_schema(const OptionList& options);

/// Returns the given `options` as words of a command line.
[[nodiscard]] std::vector<std::string> to_words(const OptionList& options);

/// Stores `words`, as `to_words` returns them, into `options`: "--spp=64", "--half", and arguments.
/// Throws `OptionError`.
void give_words(const std::vector<std::string>& words, OptionList& options);

}  // namespace bdpt::job
