#pragma once

#include <bdpt/error.h>
#include <bdpt/fields.h>

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace bdpt::app {

// The options of commands are listed once. The parser, the help texts, man pages, completions,
// plans and the Python package are loops over such a list (`OptionList`).

/// An option whose value makes no sense. main() adds to the message where the help of the command
/// is.
class OptionError : public Error {
public:
    explicit OptionError(const std::string& message) : Error(ErrorCode::usage, message) {}
};

/// Throws the `OptionError` that names all three: `--spp "VALUE": expected EXPECTED`.
[[noreturn]] void reject(std::string_view option, std::string_view value,
                         std::string_view expected);

/// What a value is in JSON.
enum class JsonType : std::uint8_t { text, whole_number, number, boolean };

/// What is known of the values of an option beside how they are parsed.
struct ValueInfo {
    JsonType json = JsonType::text;
    Range range{};                     ///< of numbers
    std::vector<std::string> words{};  ///< that it may be, if there are no others
    bool is_path = false;              ///< of a file or folder, where it is none of `words`
    bool may_be_number = false;        ///< of texts: JSON has a number where the text is one
    char separator = '\0';  ///< of several numbers, which may be an array in JSON; 0: there is one
};

/// How a text becomes a value.
template <typename T>
struct ValueType {
    std::function<std::optional<T>(const std::string&)> parse;  ///< none: it is no such value
    std::string expected;  ///< what it must be, as in "expected a number from 0 to 1"
    ValueInfo info{};
};

/// Who else than the command line takes an option.
struct OptionUses {
    bool plan_render = false;    ///< plans keep it for `bdpt render`
    bool plan_merge = false;     ///< plans keep it for `bdpt merge`
    bool python_load = false;    ///< a keyword of bdpt.load()
    bool python_render = false;  ///< a keyword of render() in Python
    bool python_save = false;    ///< a keyword of save() in Python
    bool job = true;             ///< a member of jobs (options/job_file.h)
};

/// One option of a command, or an argument that has no name before it.
struct Option {
    std::string names;    ///< "-o,--output"; of an argument its word, "file"
    std::string value;    ///< what stands for its value in the help, "FILE"; empty: a flag
    std::string help;     ///< what it does
    std::string section;  ///< title in the help; empty: that of the parser
    OptionUses uses{};
    bool required = false;
    bool repeats = false;  ///< all its values count, else the last one
    ValueInfo info{};
    /// Takes the value of a text. False: it is not what is `expected`.
    std::function<bool(const std::string&)> store;
    std::string expected{};
    std::function<void()> clear{};     ///< forgets all values of one that repeats
    std::vector<std::string> texts{};  ///< what was given; "true" for a flag

    [[nodiscard]] bool is_flag() const { return value.empty(); }
    [[nodiscard]] bool is_argument() const { return !names.starts_with('-'); }
    /// "--output", or "file" of an argument.
    [[nodiscard]] std::string name() const;
    [[nodiscard]] bool given() const { return !texts.empty(); }
    /// As one word that says the same: "--spp=64", "--half".
    [[nodiscard]] std::string word() const;
    /// `text`, or the word among `info.words` that it is but for capital letters.
    [[nodiscard]] std::string spelled(std::string text) const;
};

/// The options of a command, in the order of its help, and what was given for them.
class OptionList {
public:
    /// Options that are added from now on are in the section of that title.
    void section(std::string title, OptionUses uses = {});

    /// An option that puts the value of its last text into `target`, which outlives the list.
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

    /// An option that may be repeated, whose values are appended to `target`.
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

    /// A flag, which may also be given as --name=false.
    Option& add_flag(std::string names, std::string help, bool& target);

    /// A flag that may have a value, as --name=VALUE; without one its text is "true".
    template <typename Target, typename T>
    Option& add_flag(std::string names, std::string help, Target& target, ValueType<T> type)
    {
        Option& option = add(std::move(names), "", std::move(help), target, std::move(type));
        option.info.json = JsonType::boolean;
        return option;
    }

    /// The option of that name, as "--spp". There is one.
    [[nodiscard]] const Option& at(std::string_view name) const;
    /// Null: there is none of that name.
    [[nodiscard]] const Option* find(std::string_view name) const;
    /// Was that option given? False for one that the command has not.
    [[nodiscard]] bool given(std::string_view name) const;
    /// Throws the `OptionError` of that option, with the value that was given for it.
    [[noreturn]] void reject_value(std::string_view name, std::string_view expected) const;

    [[nodiscard]] std::deque<Option>& all() { return options_; }
    [[nodiscard]] const std::deque<Option>& all() const { return options_; }

    /// Stores all that was given, in place of what was stored before. Throws `OptionError` for the
    /// first text that is not what its option expects.
    void store_given();

private:
    Option& append(std::string names, std::string value, std::string help);

    std::deque<Option> options_;  // which stay where they are
    std::string section_;
    OptionUses uses_;
};

/// An option that means nothing without another one.
struct Need {
    std::string_view option;
    std::string_view other;  ///< or one of several, with "|" between
    std::string_view why{};  ///< said behind a colon
};

/// Options of which only one can be given.
struct Conflict {
    std::string_view option;
    std::string_view other;
    std::string_view why{};  ///< said behind a colon
};

/// Throws `OptionError` for the first of `needs` that is not met: "--fps needs --frames or
/// --orbit".
void check(std::span<const Need> needs, const OptionList& options);

/// Throws `OptionError` where both are given: "--samples cannot be combined with --spp".
void check(std::span<const Conflict> conflicts, const OptionList& options);

/// The word that `text` was probably meant to be; none when all are far from it.
[[nodiscard]] std::optional<std::string> closest(std::string_view text,
                                                 std::span<const std::string> words);

}  // namespace bdpt::app
