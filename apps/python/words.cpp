#include "words.h"

#include <bdpt/error.h>
#include <fmt/core.h>
#include <nanobind/stl/string.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

#include "options/command_options.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

struct SaveWords {
    app::DisplayWords display;
    app::DenoiseWords denoise;
    bool half = false;
    bool tiled = false;
};

void describe_save(CLI::App& parser, SaveWords& words)
{
    app::add_display_options(parser, words.display, "Output");
    app::add_denoise_options(parser, words.denoise, "Output");
    parser.add_flag("--half", words.half, "Store .exr as 16-bit floats");
    parser.add_flag("--tiled", words.tiled, "Store .exr in tiles");
    app::let_the_last_count(parser);
}

template <typename Names>
bool has(const Names& names, std::string_view name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// Does the option of bdpt render belong to that call?
bool belongs(const CLI::Option& option, Call call)
{
    static constexpr std::array of_load{"isa", "size"};
    static constexpr std::array of_neither{"isa", "profile"};
    const std::string name = option.get_lnames().empty() ? "" : option.get_lnames().front();
    const std::string group = option.get_group();
    if (call == Call::load) {
        return group == "What to render" || has(of_load, name);
    }
    return ((group == "How to render" || group == "Film") && !has(of_neither, name)) ||
           name == "background";
}

/// The options of a call, as the parser of the command has them.
class CallOptions {
public:
    explicit CallOptions(Call call)
    {
        if (call == Call::save) {
            describe_save(parser_, save_);
        } else {
            app::add_render_options(parser_, render_);
        }
        for (const CLI::Option* option : parser_.get_options()) {
            const auto& names = option->get_lnames();
            const bool wanted =
                call == Call::save ? !names.empty() && !has(names, "help") : belongs(*option, call);
            if (wanted) {
                options_.push_back(option);
            }
        }
    }
    const std::vector<const CLI::Option*>& options() const { return options_; }
    std::vector<std::string> names() const
    {
        std::vector<std::string> names;
        for (const CLI::Option* option : options_) {
            names.push_back(option->get_lnames().front());
        }
        return names;
    }

private:
    CLI::App parser_;
    app::RenderWords render_;
    SaveWords save_;
    std::vector<const CLI::Option*> options_;
};

/// "from_" is "from": the word without it means something else to Python.
std::string option_of(std::string keyword)
{
    if (keyword.ends_with('_')) {
        keyword.pop_back();
    }
    std::replace(keyword.begin(), keyword.end(), '_', '-');
    return keyword;
}

std::string value_of(const std::string& name, nb::handle value)
{
    const bool list = nb::isinstance<nb::list>(value) || nb::isinstance<nb::tuple>(value);
    if (!list) {
        return nb::cast<std::string>(nb::str(value));
    }
    const char* between = name == "size" ? "x" : ",";
    std::string text;
    for (const nb::handle item : value) {
        text += (text.empty() ? "" : between) + nb::cast<std::string>(nb::str(item));
    }
    return text;
}

void parse(CLI::App& parser, const Words& words)
{
    try {
        parser.parse(app::words_for_parser(words));
    } catch (const CLI::ParseError& error) {
        throw Error(ErrorCode::usage, error.what());
    }
}

const char* function_of(Call call)
{
    return call == Call::load ? "load()" : call == Call::render ? "render()" : "save()";
}

}  // namespace

Words words_of(const nb::kwargs& options, Call call)
{
    const std::vector<std::string> known = CallOptions(call).names();
    Words words;
    for (const auto& [key, value] : options) {
        const auto keyword = nb::cast<std::string>(key);
        const std::string name = option_of(keyword);
        if (!has(known, name)) {
            for (const Call other : {Call::load, Call::render, Call::save}) {
                if (has(CallOptions(other).names(), name)) {
                    throw Error(ErrorCode::usage,
                                fmt::format("{} is an option of {}, not of {}", keyword,
                                            function_of(other), function_of(call)));
                }
            }
            const auto meant = app::closest(name, known);
            throw Error(ErrorCode::usage,
                        fmt::format("{} has no option {}{}", function_of(call), keyword,
                                    meant ? fmt::format(" (did you mean {}?)", *meant) : ""));
        }
        if (value.is_none() || value.ptr() == Py_False) {
            continue;
        }
        words.push_back(value.ptr() == Py_True
                            ? "--" + name
                            : fmt::format("--{}={}", name, value_of(name, value)));
    }
    return words;
}

app::RenderArguments understand_render(const Words& words)
{
    CLI::App parser;
    app::RenderWords render;
    app::add_render_options(parser, render);
    app::let_the_last_count(parser);
    Words all = words;
    // Where files go is said later, to save(); layers are kept for it.
    all.insert(all.end(), {"--output=image.exr", "scene"});
    parse(parser, all);
    return app::understand(render);
}

SaveArguments understand_save(const Words& words)
{
    CLI::App parser;
    SaveWords save;
    describe_save(parser, save);
    parse(parser, words);
    return {.display = understand(save.display),
            .denoise = understand(save.denoise),
            .half = save.half,
            .tiled = save.tiled};
}

std::string option_list(Call call)
{
    std::string text;
    const CallOptions options(call);
    for (const CLI::Option* option : options.options()) {
        std::string name = option->get_lnames().front();
        std::replace(name.begin(), name.end(), '-', '_');
        text +=
            fmt::format("    {}: {}\n", name == "from" ? "from_" : name, option->get_description());
    }
    return text;
}

}  // namespace bdpt::python
