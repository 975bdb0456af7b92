#include "words.h"

#include <bdpt/error.h>
#include <fmt/core.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "options/command_parser.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

/// The options of save(), and where they go.
struct SaveRequest {
    SaveRequest()
    {
        options.section("", {.python_save = true});
        app::add_display_options(options, arguments.display);
        app::add_denoise_options(options, denoise);
        app::add_half_option(options, arguments.exr);
        app::add_tiled_option(options, arguments.exr);
    }
    SaveRequest(const SaveRequest&) = delete;
    SaveRequest& operator=(const SaveRequest&) = delete;

    SaveArguments arguments{};
    app::DenoiseArguments denoise{};
    app::OptionList options{};
};

bool has(const std::vector<std::string>& names, std::string_view name)
{
    return std::find(names.begin(), names.end(), name) != names.end();
}

bool belongs(const app::Option& option, Call call)
{
    const app::OptionUses& uses = option.uses;
    return call == Call::load     ? uses.python_load
           : call == Call::render ? uses.python_render
                                  : uses.python_save;
}

/// An option as Python has it: "look_at", and what it does.
struct Keyword {
    std::string name;
    std::string help;
};

std::vector<Keyword> keywords_of(Call call)
{
    SaveRequest save;
    app::RenderRequest render;
    app::OptionList render_options;
    app::add_render_options(render_options, render);
    std::vector<Keyword> keywords;
    for (const app::Option& option :
         call == Call::save ? save.options.all() : render_options.all()) {
        if (belongs(option, call)) {
            keywords.push_back({.name = option.name().substr(2), .help = option.help});
        }
    }
    return keywords;
}

std::vector<std::string> names_of(Call call)
{
    std::vector<std::string> names;
    for (Keyword& keyword : keywords_of(call)) {
        names.push_back(std::move(keyword.name));
    }
    return names;
}

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

const char* function_of(Call call)
{
    return call == Call::load ? "load()" : call == Call::render ? "render()" : "save()";
}

}  // namespace

Words words_of(const nb::kwargs& options, Call call)
{
    const std::vector<std::string> known = names_of(call);
    Words words;
    for (const auto& [key, value] : options) {
        const auto keyword = nb::cast<std::string>(key);
        const std::string name = option_of(keyword);
        if (!has(known, name)) {
            for (const Call other : {Call::load, Call::render, Call::save}) {
                if (has(names_of(other), name)) {
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
    Words all = words;
    // Where files go is said later, to save(); layers are kept for it.
    all.insert(all.end(), {"--output=image.exr", "scene"});
    return app::render_arguments(all);
}

SaveArguments understand_save(const Words& words)
{
    SaveRequest save;
    app::parse(save.options, words);
    save.arguments.denoise = checked(save.denoise, save.options);
    return save.arguments;
}

std::string option_list(Call call)
{
    std::string text;
    for (const Keyword& keyword : keywords_of(call)) {
        std::string name = keyword.name;
        std::replace(name.begin(), name.end(), '-', '_');
        text += fmt::format("    {}: {}\n", name == "from" ? "from_" : name, keyword.help);
    }
    return text;
}

}  // namespace bdpt::python
