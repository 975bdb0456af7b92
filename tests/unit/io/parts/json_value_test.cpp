#include <bdpt/io/json_value.h>

#include <bdpt/error.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>

#include "catch.hpp"
#include "scratch_folder.h"

namespace bdpt::io::json_value_test {
namespace {

/// The message of the `Error` that `call` throws.
std::string message_of(const std::function<void()>& call, ErrorCode code = ErrorCode::invalid_input)
{
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.code() == code);
        return error.what();
    }
    return "no error";
}

template <typename Number>
std::string refusal(const std::string& number)
{
    return message_of([&] { static_cast<void>(JsonValue::parse(number).number<Number>()); });
}

TEST_CASE("a number of JSON is read if it fits, whatever is asked for", "[json]")
{
    CHECK(JsonValue::parse("-2147483648").number<int>() == std::numeric_limits<int>::min());
    CHECK(JsonValue::parse("18446744073709551615").number<std::uint64_t>() ==
          std::numeric_limits<std::uint64_t>::max());
    CHECK(JsonValue::parse("7").number(3.0, 8.0) == 7.0);
    CHECK(JsonValue::parse("3.4028234e38").number<float>() > 3.4e38f);
    for (const char* number :
         {"1e300", "-1e300", "1e10", "0.5", "2.0", "2147483648", "-2147483649",
          "18446744073709551615", "-9223372036854775808", "null", "true", "\"5\"", "[5]"}) {
        CAPTURE(number);
        CHECK(
            refusal<int>(number).starts_with("must be an integer from -2147483648 to 2147483647"));
    }
    for (const char* number : {"-1", "4294967296", "1e300", "0.5"}) {
        CAPTURE(number);
        CHECK(refusal<std::uint32_t>(number) != "no error");
    }
    CHECK(refusal<std::uint64_t>("-1") != "no error");
    CHECK(refusal<std::int64_t>("9223372036854775808") != "no error");
    for (const char* number : {"1e39", "-1e39", "null", "\"1\""}) {
        CAPTURE(number);
        CHECK(refusal<float>(number).starts_with("must be a number from "));
    }
    CHECK(refusal<double>("1e999").starts_with("JSON: byte "));
}

TEST_CASE("what is wrong with a value of JSON is told with its place", "[json]")
{
    const JsonValue json =
        JsonValue::parse(R"({"film": {"size": [16, 1e300]}, "names": ["a", 5]})");
    CHECK(message_of([&] {
              static_cast<void>(json.at("film").at("size").at(1).number(1, 65536));
          }) == "/film/size/1: must be an integer from 1 to 65536, but is 1e+300");
    CHECK(message_of([&] { static_cast<void>(json.at("film").at("size").at(2).number<int>()); }) ==
          "/film/size: must be an array of more than 2 values, but is an array of 2");
    CHECK(message_of([&] { static_cast<void>(json.at("film").at("clamp")); }) ==
          "/film: has no \"clamp\"");
    CHECK(message_of([&] { static_cast<void>(json.at("names").texts()); }) ==
          "/names/1: must be a text, but is 5");
    CHECK(message_of([&] { static_cast<void>(json.at("names").at("a")); }) ==
          "/names: has no \"a\"");
    CHECK(message_of([&] { static_cast<void>(json.elements()); }) ==
          "must be an array, but is an object of 2");
    CHECK(message_of([&] { static_cast<void>(JsonValue::parse(R"({"a": 1, "b": 2, "a": 3})")); }) ==
          "JSON: the key \"a\" occurs twice in one object");
    CHECK(message_of([&] { static_cast<void>(JsonValue::parse(std::string(17, '['))); }) ==
          "JSON: nested deeper than 16");
}

TEST_CASE("members of an object keep their order", "[json]")
{
    std::string names;
    for (const auto& [name, value] : JsonValue::parse(R"({"z": 1, "a": 2, "m": 3})").members()) {
        names += name;
        CHECK(value.number<int>() == static_cast<int>(names.size()));
    }
    CHECK(names == "zam");
}

TEST_CASE("only regular files of a sensible size are read", "[json]")
{
    const test::ScratchFolder folder;
    test::write_text(folder / "a.json", R"({"a": [true]})");
    const JsonValue json = JsonValue::read(folder / "a.json");
    CHECK(json.at("a").at(0).boolean());
    const std::string name = (folder / "a.json").string();
    CHECK(message_of([&] { static_cast<void>(json.at("a").at(0).text()); }) ==
          name + ": /a/0: must be a text, but is true");
    CHECK(message_of([&] { json.fail("is something else"); }) == name + ": is something else");
    const auto refused = [&](const std::filesystem::path& file, ErrorCode code) {
        return message_of([&] { static_cast<void>(JsonValue::read(file)); }, code);
    };
    CHECK(refused("/dev/zero", ErrorCode::not_found) ==
          "/dev/zero: cannot be read: not a regular file");
    CHECK(refused(folder.path(), ErrorCode::not_found) ==
          folder.path().string() + ": cannot be read: not a regular file");
    CHECK(refused(folder / "b.json", ErrorCode::not_found) ==
          (folder / "b.json").string() + ": no such file");
    std::filesystem::resize_file(folder / "a.json", std::uintmax_t{8} << 30);  // takes no room
    CHECK(refused(folder / "a.json", ErrorCode::invalid_input) ==
          name + ": 8589934592 bytes, but the limit is 67108864");
}

// The time limit of tests is what these fail by: with the square of the numbers they take hours.

TEST_CASE("objects of a million keys are read in time", "[json][long]")
{
    std::string text = "{";
    for (int i = 0; i < 1'000'000; ++i) {
        text += (i > 0 ? ",\"" : "\"") + std::to_string(i) + "\":0";
    }
    CHECK(JsonValue::parse(text + "}").members().size() == 1'000'000);
    CHECK(message_of([&] { static_cast<void>(JsonValue::parse(text + ",\"77\":0}")); }) ==
          "JSON: the key \"77\" occurs twice in one object");
}

}  // namespace
}  // namespace bdpt::io::json_value_test
