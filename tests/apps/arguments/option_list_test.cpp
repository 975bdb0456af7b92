#include "options/option_list.h"

#include <bdpt/options/option_fields.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "options/render_arguments.h"
#include "options/value_types.h"

namespace bdpt::job::option_list_test {
namespace {

/// The message of what `action` throws.
template <typename Action>
std::string refusal(const Action& action)
{
    try {
        action();
    } catch (const OptionError& error) {
        return error.what();
    }
    return "";
}

TEST_CASE("each field of the list of render options that has a help text is an option")
{
    RenderRequest request;
    OptionList options;
    add_render_options(options, request);
    int fields = 0;
    for_each_option(request.arguments.options, [&](const auto& field, const auto& /*value*/) {
        if (field.info.help.empty()) {
            return;
        }
        std::string flag = "--" + std::string(field.name);
        std::replace(flag.begin(), flag.end(), '_', '-');
        CAPTURE(flag);
        ++fields;
        REQUIRE(options.find(flag) != nullptr);
        CHECK(options.at(flag).uses.python_render);
        CHECK(options.at(flag).uses.plan_render ==
              (field.info.role != OptionRole::machine));  // threads are those of a task
    });
    CHECK(fields >= 20);
}

TEST_CASE("no two options of render have one name, and each has a help text")
{
    RenderRequest request;
    OptionList options;
    add_render_options(options, request);
    std::set<std::string> names;
    for (const Option& option : options.all()) {
        CAPTURE(option.names);
        CHECK(names.insert(option.name()).second);
        CHECK(option.help.size() > 10);
        CHECK(option.help.back() != '.');
        CHECK((option.is_argument() || !option.section.empty()));
    }
}

TEST_CASE("few options name files, code or machines, and documents state few of those")
{
    RenderRequest request;
    OptionList options;
    add_render_options(options, request);
    std::map<std::string, StatedIn> restricted;
    std::set<std::string> readers;
    for (const Option& option : options.all()) {
        if (!option.is_harmless()) {
            restricted[option.name()] = option.uses.stated_in;
        } else if (option.info.is_path || option.value.find("FILE") != std::string::npos ||
                   option.value.find("DIR") != std::string::npos) {
            readers.insert(option.name());
        }
    }
    CHECK(restricted == std::map<std::string, StatedIn>{{"--output", StatedIn::own_folder},
                                                        {"--stats", StatedIn::own_folder},
                                                        {"--save-rates", StatedIn::own_folder},
                                                        {"--strategies", StatedIn::own_folder},
                                                        {"--part", StatedIn::own_folder},
                                                        {"--restart", StatedIn::programs},
                                                        {"--denoiser-library", StatedIn::programs},
                                                        {"--ktx-library", StatedIn::programs},
                                                        {"--allow-folder", StatedIn::programs},
                                                        {"others", StatedIn::command_line},
                                                        {"--plan", StatedIn::command_line},
                                                        {"--task", StatedIn::command_line},
                                                        {"--display", StatedIn::command_line},
                                                        {"--save-job", StatedIn::command_line},
                                                        {"--quiet", StatedIn::command_line},
                                                        {"--verbose", StatedIn::command_line},
                                                        {"--json", StatedIn::command_line}});
    CHECK(readers == std::set<std::string>{"file", "--rates", "--env", "--volume", "--background"});
}

TEST_CASE("options store what was given, the last text or all of them")
{
    std::int64_t number = 7;
    std::vector<std::string> words;
    bool flag = false;
    OptionList options;
    options.add("-n,--number", "N", "A number", number, whole_number(1, 9));
    options.add_repeated("--word", "W", "A word", words, any_text());
    options.add_flag("--flag", "A flag", flag);
    options.store_given();
    CHECK(number == 7);
    options.all()[0].texts = {"3", "5"};
    options.all()[1].texts = {"a", "b"};
    options.all()[2].texts = {"true"};
    for (int repeat = 0; repeat < 2; ++repeat) {  // what is stored again is not there twice
        options.store_given();
        CHECK(number == 5);
        CHECK(words == std::vector<std::string>{"a", "b"});
        CHECK(flag);
    }
    CHECK(options.given("--number"));
    CHECK_FALSE(options.given("--other"));
    CHECK(options.at("--number").word() == "--number=5");
    CHECK(options.at("--flag").word() == "--flag");
    options.all()[0].texts = {"10"};
    CHECK(refusal([&] { options.store_given(); }) ==
          "--number \"10\": expected a whole number from 1 to 9");
    CHECK(number == 5);
}

TEST_CASE("needs and conflicts of options are told in one form")
{
    bool value = false;
    OptionList options;
    for (const char* name : {"--a", "--b", "--c", "--d"}) {
        options.add_flag(name, "A flag", value);
    }
    const std::vector<Need> needs{{"--a", "--b|--c|--d"}, {"--b", "--c", "for a reason"}};
    const std::vector<Conflict> conflicts{{"--a", "--d"}};
    const auto told = [&](const std::vector<std::size_t>& given) {
        for (Option& option : options.all()) {
            option.texts.clear();
        }
        for (const std::size_t index : given) {
            options.all()[index].texts = {"true"};
        }
        return refusal([&] {
            check(needs, options);
            check(conflicts, options);
        });
    };
    CHECK(told({}).empty());
    CHECK(told({0}) == "--a needs --b, --c or --d");
    CHECK(told({0, 2}).empty());
    CHECK(told({1}) == "--b needs --c: for a reason");
    CHECK(told({0, 3}) == "--a cannot be combined with --d");
}

}  // namespace
}  // namespace bdpt::job::option_list_test
