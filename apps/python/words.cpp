#include "words.h"

#include <bdpt/error.h>
#include <fmt/core.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>

#include "messages/text.h"
#include "options/groups/view_arguments.h"
#include "options/option_list.h"
#include "options/value_types.h"
#include "python_errors.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

/// The options of save(), and the arguments that they are stored in.
struct SaveRequest {
    SaveRequest()
    {
        options.section("", {.python_save = true});
        job::add_display_options(options, arguments.display);
        job::add_denoise_options(options, arguments.denoise);
        job::add_half_option(options, arguments.exr);
        job::add_tiled_option(options, arguments.exr);
    }
    SaveRequest(const SaveRequest&) = delete;
    SaveRequest& operator=(const SaveRequest&) = delete;

    SaveArguments arguments{};
    job::OptionList options{};
};

/// Returns all options of the command.
const job::OptionList& render_options()
{
    static const job::RenderOptionList options;
    return options.list;
}

bool belongs(const job::Option& option, Call call)
{
    const job::OptionUses& uses = option.uses;
    switch (call) {
        case Call::load:
            return uses.python_load;
        case Call::render:
            return uses.python_render;
        case Call::save:
            return uses.python_save;
        case Call::run:
            return uses.stated_in <= job::StatedIn::programs && !option.is_argument();
    }
    return false;
}

/// Calls `visit(option)` for each option of `call`.
template <typename Visitor>
void visit_options(Call call, const Visitor& visit)
{
    const SaveRequest save;
    const job::RenderOptionList render;
    for (const job::Option& option : (call == Call::save ? save.options : render.list).all()) {
        if (belongs(option, call)) {
            visit(option);
        }
    }
}

/// Returns "look_at" for --look-at. "from" is a keyword of Python.
std::string to_keyword(const job::Option& option)
{
    const std::string key = to_key(option);
    return key == "from" ? "from_" : key;
}

std::vector<std::string> collect_keywords(Call call)
{
    std::vector<std::string> keywords;
    visit_options(
        call, [&keywords](const job::Option& option) { keywords.push_back(to_keyword(option)); });
    return keywords;
}

/// Tests for an array of NumPy, a list, a tuple or a range, but no text.
bool has_items(nb::handle value)
{
    if (nb::isinstance<nb::str>(value) || nb::isinstance<nb::bytes>(value)) {
        return false;
    }
    PyObject* iterator = PyObject_GetIter(value.ptr());
    PyErr_Clear();
    Py_XDECREF(iterator);
    return iterator != nullptr;
}

std::string to_text(nb::handle value)
{
    if (nb::hasattr(value, "__fspath__")) {
        return nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(value));
    }
    return nb::cast<std::string>(nb::str(value));
}

std::string to_text(const job::Option& option, nb::handle value)
{
    if (!has_items(value)) {
        return to_text(value);
    }
    const char between = option.info.separator != '\0' ? option.info.separator : ',';
    std::string text;
    for (const nb::handle item : nb::iter(value)) {
        text += (text.empty() ? "" : std::string(1, between)) + to_text(item);
    }
    return text;
}

/// Returns the texts of an option that may repeat, or of one that does not.
std::vector<std::string> to_texts(const job::Option& option, nb::handle value)
{
    if (!option.repeats || !has_items(value)) {
        return {to_text(option, value)};
    }
    std::vector<std::string> texts;
    for (const nb::handle item : nb::iter(value)) {
        texts.push_back(to_text(item));
    }
    return texts;
}

/// Returns a number of Python or NumPy; else the text of `value`.
JobValue to_number(nb::handle value)
{
    if (PyIndex_Check(value.ptr()) != 0) {
        const nb::object whole = nb::steal(PyNumber_Index(value.ptr()));
        std::uint64_t number = 0;
        if (nb::try_cast(whole, number)) {
            return number;
        }
        return nb::cast<std::int64_t>(whole);
    }
    double number = 0.0;
    return nb::try_cast(value, number) ? JobValue(number) : JobValue(to_text(value));
}

JobValue to_value(const job::Option& option, nb::handle value)
{
    if (option.repeats && has_items(value)) {
        const std::vector<std::string> texts = to_texts(option, value);
        return std::vector<JobValue>(texts.begin(), texts.end());
    }
    if (value.ptr() == Py_True || value.ptr() == Py_False) {
        return value.ptr() == Py_True;
    }
    const bool is_number = option.info.json == job::JsonType::whole_number ||
                           option.info.json == job::JsonType::number;
    return is_number && !has_items(value) ? to_number(value) : JobValue(to_text(option, value));
}

/// Names of types, for stubs.
constexpr const char* whole = "typing.SupportsIndex";  // int, and integers of NumPy
constexpr const char* real = "typing.SupportsFloat";   // int, float, and those of NumPy
constexpr const char* path = "str | os.PathLike[str]";

std::string literals(const std::vector<std::string>& words)
{
    std::string list;
    for (const std::string& word : words) {
        const bool is_number = word.find_first_not_of("0123456789") == std::string::npos;
        list +=
            fmt::format("{}\"{}\"{}", list.empty() ? "" : ", ", word, is_number ? ", " + word : "");
    }
    return fmt::format("typing.Literal[{}]", list);
}

/// Returns the Python type of the values of `option`.
std::string format_type(const job::Option& option)
{
    const job::ValueInfo& info = option.info;
    if (option.is_flag()) {
        std::vector<std::string> words = info.words;
        std::erase_if(words, [](const auto& word) { return word == "true" || word == "false"; });
        return words.empty() ? "bool" : "bool | " + literals(words);
    }
    if (info.is_path) {
        return option.repeats ? fmt::format("{0} | collections.abc.Iterable[{0}]", path) : path;
    }
    if (!info.words.empty()) {
        return literals(info.words);
    }
    if (info.json == job::JsonType::whole_number) {
        return whole;
    }
    if (info.json == job::JsonType::number) {
        return real;
    }
    if (info.may_be_number) {
        return fmt::format("str | {}", real);
    }
    return fmt::format("str | {} | collections.abc.Iterable[{}{}]", real,
                       info.separator != '\0' ? "" : "str | ", real);
}

const char* format_call(Call call)
{
    return call == Call::load     ? "load()"
           : call == Call::render ? "render()"
           : call == Call::save   ? "save()"
                                  : "run()";
}

[[noreturn]] void fail_unknown(const std::string& keyword, Call call)
{
    for (const Call other : {Call::load, Call::render, Call::save, Call::run}) {
        if (job::is_among(collect_keywords(other), keyword)) {
            throw CallError(
                fmt::format("{} got an unexpected keyword argument '{}': it is an option of {}",
                            format_call(call), keyword, format_call(other)));
        }
    }
    std::string name = "--" + keyword;
    std::replace(name.begin(), name.end(), '_', '-');
    const auto foreign = job::find_foreign(name, render_options());
    const job::Option* const ours = foreign ? render_options().find(foreign->option) : nullptr;
    fail_keyword(format_call(call), keyword,
                 ours != nullptr && belongs(*ours, call)
                     ? to_keyword(*ours)
                     : job::closest(keyword, collect_keywords(call)));
}

/// Tests whether a value can be an option: a text, a path, a number, or several of them.
bool can_be_option(const job::Option& option, nb::handle value)
{
    const bool is_bool = PyBool_Check(value.ptr()) != 0;
    const bool is_number = PyNumber_Check(value.ptr()) != 0;
    if (is_bool || (is_number && !has_items(value))) {
        const bool is_whole = is_bool || PyIndex_Check(value.ptr()) != 0;
        return is_bool ? option.is_flag()
                       : is_whole || option.info.json != job::JsonType::whole_number;
    }
    return has_items(value) || PyUnicode_Check(value.ptr()) != 0 ||
           nb::hasattr(value, "__fspath__");
}

/// Throws unless the value is as its option expects. Paths and combinations are checked later.
void check_value(const job::Option& option, nb::handle value, Call call)
{
    const auto expect = [&](const std::string& meant) {
        return fmt::format("{}={}: expected {}{}", to_keyword(option), written(value),
                           option.expected, meant);
    };
    if (!can_be_option(option, value)) {
        throw CallError(expect(""));
    }
    if (PyBool_Check(value.ptr()) != 0) {
        return;
    }
    for (const std::string& text : to_texts(option, value)) {
        if (!option.store(option.spelled(text))) {
            const auto meant = option.meant(text);
            throw Error(call == Call::run ? ErrorCode::invalid_input : ErrorCode::usage,
                        expect(meant ? fmt::format(" (did you mean '{}'?)", *meant) : ""));
        }
    }
}

/// Calls `visit(option, value)` for each of `values` that is not None, in their order. Throws
/// before that unless all keywords are options of `call` and all values are as these expect.
template <typename Visitor>
void visit_given(const nb::kwargs& values, Call call, const Visitor& visit)
{
    const SaveRequest save;
    const job::RenderOptionList render;
    std::map<std::string, const job::Option*> known;
    for (const job::Option& option : (call == Call::save ? save.options : render.list).all()) {
        if (belongs(option, call)) {
            known.emplace(to_keyword(option), &option);
        }
    }
    std::vector<std::pair<const job::Option*, nb::handle>> given;
    for (const auto& [key, value] : values) {
        const auto keyword = nb::cast<std::string>(key);
        const auto found = known.find(keyword == "from" ? "from_" : keyword);
        if (found == known.end()) {
            fail_unknown(keyword, call);
        }
        if (!value.is_none()) {
            given.emplace_back(found->second, value);
        }
    }
    for (const auto& [option, value] : given) {
        check_value(*option, value, call);
    }
    for (const auto& [option, value] : given) {
        visit(*option, value);
    }
}

/// Wraps `text` to lines of at most 100 columns, each behind `indent` spaces.
std::string wrapped(const std::string& text, std::size_t indent)
{
    constexpr std::size_t columns = 100;
    const std::string lines = job::wrapped(text, columns - indent);
    std::string result;
    for (const std::string_view line : job::split(lines, '\n')) {
        result += std::string(indent, ' ') + std::string(line) + "\n";
    }
    return result;
}

/// Returns "--fov" for "--fov=30".
std::string_view parse_name(std::string_view word)
{
    return word.substr(0, word.find('='));
}

/// Tests whether two options of a view exclude each other.
bool exclude(std::string_view one, std::string_view other)
{
    static const std::vector<job::Conflict> conflicts = job::view_conflicts();
    return std::any_of(conflicts.begin(), conflicts.end(), [&](const job::Conflict& pair) {
        return (pair.option == one && pair.other == other) ||
               (pair.option == other && pair.other == one);
    });
}

}  // namespace

bool change_view(const Words& words)
{
    return without_view(words).size() != words.size();
}

Words without_view(Words words)
{
    visit_options(Call::load, [&words](const job::Option& option) {
        if (option.uses.python_render && option.name() != "--size") {
            std::erase_if(words, [&option](const std::string& word) {
                return parse_name(word) == option.name();
            });
        }
    });
    return words;
}

std::optional<std::string> find_unsafe(const Words& words)
{
    std::vector<std::string> safe;
    visit_options(Call::load, [&safe](const job::Option& option) {
        if (option.is_harmless()) {
            safe.push_back(option.name());
        }
    });
    const auto found = std::find_if(words.begin(), words.end(), [&safe](const std::string& word) {
        return !job::is_among(safe, parse_name(word));
    });
    return found != words.end() ? std::optional(*found) : std::nullopt;
}

Words combined(const Words& of_load, const Words& of_render)
{
    Words words;
    for (const std::string& word : of_load) {
        const bool replaced =
            std::any_of(of_render.begin(), of_render.end(), [&word](const std::string& other) {
                return exclude(parse_name(word), parse_name(other));
            });
        if (!replaced) {
            words.push_back(word);
        }
    }
    words.insert(words.end(), of_render.begin(), of_render.end());
    return words;
}

Words to_words(const nb::kwargs& options, Call call)
{
    Words words;
    visit_given(options, call, [&words](const job::Option& option, nb::handle value) {
        if (value.ptr() == Py_True) {
            words.push_back(option.name());
        } else if (value.ptr() != Py_False) {
            for (const std::string& text : to_texts(option, value)) {
                words.push_back(fmt::format("{}={}", option.name(), text));
            }
        } else if (option.default_is_chosen) {
            words.push_back(option.name() + "=false");
        }
    });
    return words;
}

void set_options(RenderJob& job, const nb::kwargs& options)
{
    visit_given(options, Call::run, [&job](const job::Option& option, nb::handle value) {
        const bool is_off = value.ptr() == Py_False && !option.default_is_chosen;
        job.set(to_key(option), is_off ? JobValue(nullptr) : to_value(option, value));
    });
}

std::vector<std::filesystem::path> given_paths(const nb::kwargs& options, Call call)
{
    std::vector<std::filesystem::path> paths;
    visit_options(call, [&](const job::Option& option) {
        const std::string keyword = to_keyword(option);
        // Not the files that it writes.
        if (!option.info.is_path || !option.is_harmless() || !options.contains(keyword.c_str())) {
            return;
        }
        const std::string text = to_text(options[keyword.c_str()]);
        if (!job::is_among(option.info.words, text)) {
            paths.emplace_back(text);
        }
    });
    return paths;
}

std::string in_keywords(std::string_view message)
{
    std::string text;
    std::size_t done = 0;
    for (std::size_t at = message.find("--"); at != std::string_view::npos;
         at = message.find("--", at + 2)) {
        constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz-0123456789";
        const std::size_t end = std::min(message.find_first_not_of(letters, at), message.size());
        const bool begins = at == 0 || message[at - 1] == ' ' || message[at - 1] == '(';
        const bool is_part_of_path = end < message.size() && message[end] == '/';
        const auto* const option = render_options().find(message.substr(at, end - at));
        if (!begins || is_part_of_path || option == nullptr) {
            continue;
        }
        text += message.substr(done, at - done);
        text += to_keyword(*option);
        done = end;
        if (message.substr(end).starts_with(" \"")) {
            text += '=';
            ++done;
        }
    }
    return text + std::string(message.substr(done));
}

job::RenderArguments understand_render(const Words& words)
{
    Words all = words;
    // The output is a placeholder, as save() names files later; layers are kept for it. Views have
    // numbers.
    all.insert(all.end(), {"--output=image.####.exr", "scene"});
    return job::render_arguments(all);
}

SaveArguments understand_save(const Words& words)
{
    SaveRequest save;
    job::give_words(words, save.options);
    return save.arguments;
}

std::string declaration(std::string_view head, Call call, std::string_view result)
{
    std::string text(head);
    visit_options(call, [&text, call](const job::Option& option) {
        const bool may_be_camera = call == Call::render && option.name() == "--camera";
        text += fmt::format(", {}: {}{} | None = None", to_keyword(option), format_type(option),
                            may_be_camera ? " | Camera" : "");
    });
    return fmt::format("{}) -> {}", text, result);
}

std::string documentation(std::string_view text, Call call)
{
    std::string result = wrapped(std::string(text), 0) + "\nOptions:\n";
    visit_options(call, [&result](const job::Option& option) {
        const std::string value = option.is_flag() ? "True" : option.value;
        result += fmt::format("    {}: {}\n{}", to_keyword(option), value, wrapped(option.help, 8));
    });
    return result;
}

}  // namespace bdpt::python
