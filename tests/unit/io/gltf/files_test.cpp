#include "../gltf_fixture.h"
#include "catch.hpp"
#include "file/messages.h"
#include "file/read_file.h"

#include <bdpt/io/gltf.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::test::files_test {
using namespace bdpt::io;
using namespace std::string_literals;

namespace {

/// A triangle whose buffer is at a URI.
std::string with_buffer_uri(const std::string& uri, std::size_t byte_length = 42)
{
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["buffers"] = {{{"byteLength", byte_length}, {"uri", uri}}};
    return fixture.text();
}

std::string triangle_bytes()
{
    return GltfFixture::triangle().bin;
}

/// A data URI with lines of 20 base64 digits, as MIME has.
std::string with_line_breaks(std::string_view bytes)
{
    std::string text = base64(bytes);
    for (std::size_t at = 20; at < text.size(); at += 22) {
        text.insert(at, "\r\n");
    }
    return "data:;base64," + text + "\n";
}

}  // namespace

TEST_CASE("an allocation that fails is told with what the process had and may have")
{
    const auto fail = []() -> int { throw std::bad_alloc(); };
    std::string message;
    try {
        static_cast<void>(with_named_errors("scene.gltf", fail));
    } catch (const Error& error) {
        message = error.what();
        CHECK(error.code() == ErrorCode::out_of_memory);
    }
    CHECK(contains(message, "scene.gltf: not enough memory: the process used up to "));
    CHECK(contains(message, "B and needs more"));
    CHECK_FALSE(contains(message, "up to 0 B"));

    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_AS, &before) == 0);
    if (before.rlim_cur == RLIM_INFINITY) {
        rlimit limited = before;
        limited.rlim_cur = std::min<rlim_t>(before.rlim_max, rlim_t{1} << 46U);
        REQUIRE(::setrlimit(RLIMIT_AS, &limited) == 0);
        const std::string figures = memory_figures();
        ::setrlimit(RLIMIT_AS, &before);
        CHECK(contains(figures, "but its limit is 70.4 TB"));
    }
}

TEST_CASE("buffers come from files next to the scene")
{
    const TempFolder folder;
    folder.write("data/mesh 1.bin", triangle_bytes());
    for (const char* uri :
         {"data/mesh%201.bin", "data/mesh 1.bin", "./data/../data/mesh%201.bin"}) {
        CAPTURE(uri);
        const LoadedScene loaded = load_gltf(folder.write("scene.gltf", with_buffer_uri(uri)));
        CHECK(loaded.scene.meshes.at(0).positions.at(1) == Vec3(1, 0, 0));
        CHECK(loaded.warnings.empty());
    }
}

TEST_CASE("scenes and buffers may have any name")
{
    const TempFolder folder;
    folder.write("a b/\xc3\xa4%41.bin", triangle_bytes());
    const auto file = folder.write("a b/sc\xc3\xa8ne #1.gltf", with_buffer_uri("%C3%A4%2541.bin"));
    CHECK(load_gltf(file).scene.instances.size() == 1);
}

TEST_CASE("a relative path to a scene in the working folder works")
{
    const TempFolder folder;
    folder.write("mesh.bin", triangle_bytes());
    folder.write("scene.gltf", with_buffer_uri("mesh.bin"));
    const std::filesystem::path before = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    const Error error = load_error("scene.gltf");
    std::filesystem::current_path(before);
    CHECK(std::string(error.what()).empty());
}

TEST_CASE("data URIs hold base64 or percent-encoded bytes")
{
    const TempFolder folder;
    const std::string bytes = triangle_bytes();
    std::string escaped = "data:,";
    for (const char byte : bytes) {
        constexpr const char* digits = "0123456789abcdef";
        escaped += '%';
        escaped += digits[static_cast<unsigned char>(byte) >> 4];
        escaped += digits[static_cast<unsigned char>(byte) & 15];
    }
    for (const std::string& uri : {"data:;base64," + base64(bytes), escaped,
                                   "DATA:application/gltf-buffer;base64," + base64(bytes),
                                   "data:application/octet-stream;BASE64," + base64(bytes),
                                   "data:; Base64 ," + base64(bytes), with_line_breaks(bytes)}) {
        const auto file = folder.write("scene.gltf", with_buffer_uri(uri));
        CHECK(load_gltf(file).scene.meshes.at(0).positions.at(2) == Vec3(0, 1, 0));
    }
}

TEST_CASE("malformed data URIs are refused")
{
    const TempFolder folder;
    const auto message = [&folder](const std::string& uri) {
        const Error error = load_error(folder.write("scene.gltf", with_buffer_uri(uri)));
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(contains(error.what(), "/buffers/0/"));
        return std::string(error.what());
    };
    CHECK(contains(message("data:;base64,AA*A"), "base64 digit 2: byte 0x2a"));
    CHECK(contains(message("data:;base64,AA A\nA A"), "base64 text of 5 digits is truncated"));
    CHECK(contains(message("data:;base64,AAAAA"), "truncated"));
    CHECK(contains(message("data:;base64"), "without a comma"));
    CHECK(contains(message("data:;base64,AAAA"), "/byteLength: 42 bytes, but there are 3"));
}

TEST_CASE("nothing outside of the scene's folder is read")
{
    const TempFolder outside;
    const auto secret = outside.write("secret.bin", triangle_bytes());
    const TempFolder folder;
    std::filesystem::create_symlink(secret, folder.path() / "link.bin");
    std::filesystem::create_directory_symlink(outside.path(), folder.path() / "linked");
    const std::string up = "../" + outside.path().filename().string() + "/secret.bin";
    for (const std::string& uri :
         {up, "sub/../" + up, "%2e%2e/" + up.substr(3), secret.string(), "link.bin"s,
          "linked/secret.bin"s, "file://" + secret.string(), "http://example.org/a.bin"s,
          "\\\\host\\share"s, ""s, "a%00b"s}) {
        CAPTURE(uri);
        const Error error = load_error(folder.write("scene.gltf", with_buffer_uri(uri)));
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(contains(error.what(), "/buffers/0/uri: "));
    }
    // Images too, even if no material uses them.
    GltfFixture fixture = GltfFixture::triangle();
    fixture.json["images"] = {{{"uri", up}}};
    const Error error = load_error(folder.write("scene.gltf", fixture.text()));
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "/images/0/uri: "));
    CHECK(contains(error.what(), "leads to \"" + std::filesystem::canonical(secret).string()));
    CHECK(contains(error.what(), "outside of the scene's folder; --allow-folder allows others"));
    const Error link = load_error(folder.write("scene.gltf", with_buffer_uri("link.bin")));
    CHECK(contains(link.what(), "\"link.bin\": is a link to \"" +
                                    std::filesystem::canonical(secret).string() + "\", outside"));
}

TEST_CASE("what lies in an allowed folder is read")
{
    const TempFolder store;
    const auto mesh = store.write("data/mesh.bin", triangle_bytes());
    const TempFolder folder;
    std::filesystem::create_symlink(mesh, folder.path() / "link.bin");
    const std::string up = "../" + store.path().filename().string() + "/data/mesh.bin";
    for (const std::string& uri : {up, "link.bin"s}) {
        CAPTURE(uri);
        const auto file = folder.write("scene.gltf", with_buffer_uri(uri));
        const auto code = [&file](const std::vector<std::filesystem::path>& allowed) {
            GltfOptions options;
            options.allowed_folders = allowed;
            return load_error(file, options).code();
        };
        constexpr ErrorCode none = ErrorCode::internal;
        CHECK(code({}) == ErrorCode::invalid_input);
        CHECK(code({store.path()}) == none);
        CHECK(code({folder.path(), store.path() / "other/../data"}) == ErrorCode::not_found);
        CHECK(code({folder.path(), store.path() / "data/"}) == none);
        CHECK(code({store.path() / "dat"}) == ErrorCode::not_found);
        CHECK(code({mesh}) == ErrorCode::not_found);
        CHECK(code({""}) == ErrorCode::not_found);
        CHECK(code({folder.path()}) == ErrorCode::invalid_input);
        CHECK_FALSE(gltf_file_contents(file)[1].hash);
        CHECK(gltf_file_contents(file, {}, {store.path()})[1].hash == hash_of_file(mesh));
    }
    // An allowed folder is no base of URIs, and allows nothing but what is named by relative ones.
    for (const std::string& uri : {"data/mesh.bin"s, mesh.string()}) {
        GltfOptions options;
        options.allowed_folders = {store.path()};
        const Error error = load_error(folder.write("scene.gltf", with_buffer_uri(uri)), options);
        CHECK_FALSE(std::string(error.what()).empty());
    }
}

TEST_CASE("backslashes are slashes where only that leads to a file")
{
    const TempFolder folder;
    folder.write("data/mesh.bin", triangle_bytes());
    for (const char* uri : {"data\\mesh.bin", ".\\data\\mesh.bin", "data%5Cmesh.bin"}) {
        CAPTURE(uri);
        const LoadedScene loaded = load_gltf(folder.write("scene.gltf", with_buffer_uri(uri)));
        CHECK(loaded.scene.instances.size() == 1);
        REQUIRE(loaded.warnings.size() == 1);
        CHECK(loaded.warnings[0] == "/buffers/0/uri: \"" + std::string(uri) +
                                        "\": a backslash in a URI is read as a slash");
        CHECK(loaded.files.at(0) == std::filesystem::canonical(folder.path() / "data/mesh.bin"));
    }
    const auto file = folder.write("scene.gltf", with_buffer_uri("data\\mesh.bin"));
    folder.write("data\\mesh.bin", triangle_bytes());
    CHECK(load_gltf(file).warnings.empty());
    // Neither name, nor a way out of the folder.
    const TempFolder outside;
    outside.write("mesh.bin", triangle_bytes());
    const std::string up = "..\\" + outside.path().filename().string() + "\\mesh.bin";
    for (const std::string& uri : {"data\\no.bin"s, up}) {
        const Error error = load_error(folder.write("scene.gltf", with_buffer_uri(uri)));
        CHECK(error.code() == ErrorCode::not_found);
        CHECK(contains(error.what(), "no such file"));
    }
}

TEST_CASE("links within the scene's folder are followed")
{
    const TempFolder folder;
    folder.write("real/mesh.bin", triangle_bytes());
    std::filesystem::create_symlink("real/mesh.bin", folder.path() / "link.bin");
    const auto file = folder.write("scene.gltf", with_buffer_uri("link.bin"));
    CHECK(load_gltf(file).scene.instances.size() == 1);
}

TEST_CASE("missing and unreadable files are named")
{
    const TempFolder folder;
    const Error missing = load_error(folder.path() / "none.gltf");
    CHECK(missing.code() == ErrorCode::not_found);
    CHECK(missing.what() == (folder.path() / "none.gltf").string() + ": no such file");

    const Error directory = load_error(folder.path());
    CHECK(directory.code() == ErrorCode::not_found);
    CHECK(contains(directory.what(), "not a regular file"));

    const auto file = folder.write("scene.gltf", with_buffer_uri("mesh.bin"));
    const Error buffer = load_error(file);
    CHECK(buffer.code() == ErrorCode::not_found);
    CHECK(buffer.what() == file.string() + ": /buffers/0/uri: \"mesh.bin\": no such file");
}

TEST_CASE("buffers may be longer than they say, but not shorter")
{
    const TempFolder folder;
    folder.write("mesh.bin", triangle_bytes());
    const Error error = load_error(folder.write("scene.gltf", with_buffer_uri("mesh.bin", 43)));
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "/buffers/0/byteLength: 43 bytes, but there are 42"));

    folder.write("mesh.bin", triangle_bytes() + "more");
    const LoadedScene loaded =
        load_gltf(folder.write("scene.gltf", with_buffer_uri("mesh.bin", 42)));
    CHECK(loaded.scene.instances.size() == 1);
    CHECK(warns(loaded.warnings, {"/buffers/0/byteLength: 42", "more bytes"}));
}

TEST_CASE("files beyond the limit are refused")
{
    const TempFolder folder;
    const auto file = folder.write("scene.gltf", GltfFixture::triangle().text());
    GltfOptions options;
    options.limits.file_bytes = 100;
    const Error error = load_error(file, options);
    CHECK(error.code() == ErrorCode::invalid_input);
    CHECK(contains(error.what(), "bytes, but the limit is 100"));
}

TEST_CASE("percent signs that encode nothing stay")
{
    CHECK(percent_decode("100%.png") == "100%.png");
    CHECK(percent_decode("%4") == "%4");
    CHECK(percent_decode("%zz%41%") == "%zzA%");
}

TEST_CASE("what is in the files of a scene is told by name, used or not")
{
    const TempFolder folder;
    nlohmann::json json = GltfFixture::triangle().json;
    json["buffers"] = {{{"byteLength", 42}, {"uri", "b%20c.bin"}},
                       {{"byteLength", 1}, {"uri", "data:;base64,AAAA"}}};
    json["images"] = {
        {{"uri", "unused.png"}}, {{"uri", "absent.png"}}, {{"uri", "../outside.png"}}};
    json["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", "lamp.ies"}}};
    const std::map<std::string, std::string> texts{{"scene.gltf", json.dump()},
                                                   {"b c.bin", triangle_bytes()},
                                                   {"unused.png", "x"},
                                                   {"lamp.ies", "y"}};
    for (const auto& [name, text] : texts) {
        folder.write(name, text);
    }
    const auto file = folder.path() / "scene.gltf";
    const std::vector<FileContent> before = gltf_file_contents(file);
    std::vector<std::string> names;
    for (const FileContent& content : before) {
        names.push_back(content.name);
        const bool readable = content.name != "absent.png" && content.name != "../outside.png";
        CHECK(content.hash.has_value() == readable);
    }
    CHECK(names == std::vector<std::string>{"scene.gltf", "../outside.png", "absent.png",
                                            "b%20c.bin", "lamp.ies", "unused.png"});
    CHECK(before[0].hash == hash_of_file(file));
    CHECK(before[4].hash == hash_of_file(folder.path() / "lamp.ies"));
    for (const auto& [name, text] : texts) {
        CAPTURE(name);
        folder.write(name, text + " ");
        CHECK(gltf_file_contents(file) != before);
        folder.write(name, text);
        CHECK(gltf_file_contents(file) == before);
    }
    const auto glb = folder.write("scene.glb", GltfFixture::triangle().glb());
    CHECK(gltf_file_contents(glb).size() == 1);
}

TEST_CASE("the contents of what is no scene are refused by its name")
{
    const TempFolder folder;
    const auto message = [](const std::filesystem::path& file) -> std::string {
        try {
            static_cast<void>(gltf_file_contents(file));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    CHECK(contains(message(folder.path() / "none.gltf"), "none.gltf: no such file"));
    CHECK(contains(message(folder.write("text.gltf", "text")), "text.gltf: "));
    CHECK_THROWS_AS(hash_of_file(folder.path() / "none"), Error);
    CHECK_THROWS_AS(hash_of_file(folder.write("long", "1234"), {.file_bytes = 3}), Error);
}

}  // namespace bdpt::test::files_test
