#include "gltf_fixture.h"

#include <algorithm>
#include <atomic>
#include <fstream>
#include <stdexcept>

#include <unistd.h>

namespace bdpt::io {

TempFolder::TempFolder()
{
    static std::atomic<int> counter{0};
    path_ = std::filesystem::temp_directory_path() /
            ("bdpt_io_" + std::to_string(getpid()) + "_" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
}

TempFolder::~TempFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path TempFolder::write(const std::string& name, std::string_view bytes) const
{
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream stream(file, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!stream.flush()) {
        throw std::runtime_error("cannot write " + file.string());
    }
    return file;
}

std::string base64(std::string_view bytes)
{
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            word = word << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += k <= n ? digits[word >> (18 - 6 * k) & 63u] : '=';
        }
    }
    return text;
}

GltfFixture::GltfFixture()
    : json{{"asset", {{"version", "2.0"}}},
           {"scene", 0},
           {"scenes", {{{"nodes", nlohmann::json::array()}}}}}
{}

GltfFixture GltfFixture::triangle()
{
    GltfFixture fixture;
    fixture.add_accessor(f32, "VEC3", 3, bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}));
    fixture.add_accessor(u16, "SCALAR", 3, bytes_of<std::uint16_t>({0, 1, 2}));
    fixture.add_mesh_node({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
    return fixture;
}

int GltfFixture::add_view(std::string_view bytes)
{
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    json["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}});
    bin += bytes;
    return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfFixture::add_accessor(ComponentType component, const std::string& type, std::size_t count,
                              std::string_view bytes)
{
    const int view = add_view(bytes);
    json["accessors"].push_back({{"bufferView", view},
                                 {"componentType", static_cast<int>(component)},
                                 {"count", count},
                                 {"type", type}});
    return static_cast<int>(json["accessors"].size()) - 1;
}

void GltfFixture::add_mesh_node(const nlohmann::json& primitive)
{
    json["meshes"].push_back({{"primitives", {primitive}}});
    json["nodes"].push_back({{"mesh", json["meshes"].size() - 1}});
    json["scenes"][0]["nodes"].push_back(json["nodes"].size() - 1);
}

std::string GltfFixture::text() const
{
    nlohmann::json document = json;
    if (!bin.empty() && !document.contains("buffers")) {
        document["buffers"] = {{{"byteLength", bin.size()},
                                {"uri", "data:application/octet-stream;base64," + base64(bin)}}};
    }
    return document.dump();
}

std::string GltfFixture::glb() const
{
    nlohmann::json document = json;
    if (!bin.empty() && !document.contains("buffers")) {
        document["buffers"] = {{{"byteLength", bin.size()}}};
    }
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string data = bin;
    data.resize((data.size() + 3) / 4 * 4, '\0');
    const auto size = [](std::size_t n) { return static_cast<std::uint32_t>(n); };
    return "glTF" + bytes_of<std::uint32_t>({2, size(12 + 8 + text.size() + 8 + data.size())}) +
           bytes_of<std::uint32_t>({size(text.size())}) + "JSON" + text +
           bytes_of<std::uint32_t>({size(data.size())}) + std::string("BIN\0", 4) + data;
}

LoadedScene GltfFixture::load(const GltfOptions& options) const
{
    const TempFolder folder;
    return load_gltf(folder.write("scene.gltf", text()), options);
}

Error GltfFixture::error(const GltfOptions& options) const
{
    const TempFolder folder;
    return load_error(folder.write("scene.gltf", text()), options);
}

Error load_error(const std::filesystem::path& file, const GltfOptions& options)
{
    try {
        static_cast<void>(load_gltf(file, options));
    } catch (const Error& error) {
        return error;
    }
    return Error(ErrorCode::internal, "");
}

bool contains(std::string_view text, std::string_view part)
{
    return text.find(part) != std::string_view::npos;
}

bool warns(const std::vector<std::string>& warnings, const std::vector<std::string>& parts)
{
    return std::any_of(warnings.begin(), warnings.end(), [&parts](const std::string& warning) {
        return std::all_of(parts.begin(), parts.end(),
                           [&warning](const std::string& part) { return contains(warning, part); });
    });
}

}  // namespace bdpt::io
