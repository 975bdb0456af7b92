#pragma once

#include <bdpt/error.h>
#include <bdpt/io/gltf.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// A folder of its own for a test, deleted with all that is in it.
class TempFolder {
public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// Writes a file and returns its path; folders on the way are made.
    std::filesystem::path write(const std::string& name, std::string_view bytes) const;

private:
    std::filesystem::path path_;
};

[[nodiscard]] std::string base64(std::string_view bytes);

/// The bytes of numbers of one type.
template <typename T>
[[nodiscard]] std::string bytes_of(const std::vector<T>& values)
{
    return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

enum ComponentType : int {
    i8 = 5120,
    u8 = 5121,
    i16 = 5122,
    u16 = 5123,
    u32 = 5125,
    f32 = 5126,
};

/// A glTF document in the making, with one buffer.
struct GltfFixture {
    nlohmann::json json;
    std::string bin;

    /// No nodes, no meshes, one empty scene.
    GltfFixture();
    /// One node with one mesh: the triangle (0,0,0), (1,0,0), (0,1,0), indexed by 16 bits. Accessor
    /// 0 and view 0 hold the positions, 1 and 1 the indices.
    [[nodiscard]] static GltfFixture triangle();

    /// Adds a bufferView with these bytes, aligned to 4, and returns its index.
    int add_view(std::string_view bytes);
    /// Adds an accessor on a view of its own and returns its index.
    int add_accessor(ComponentType component, const std::string& type, std::size_t count,
                     std::string_view bytes);
    /// Adds a node with a mesh of this primitive to the scene.
    void add_mesh_node(const nlohmann::json& primitive);

    /// The text of a .gltf file, with the buffer as a data URI.
    [[nodiscard]] std::string text() const;
    /// The bytes of a .glb file.
    [[nodiscard]] std::string glb() const;
    /// Writes it as a .gltf file and loads that.
    [[nodiscard]] LoadedScene load(const GltfOptions& options = {}) const;
    /// The error that loading gives; its code is `internal` and its text empty if there is none.
    [[nodiscard]] Error error(const GltfOptions& options = {}) const;
};

/// What load_gltf throws for a file; `internal` and an empty text if nothing.
[[nodiscard]] Error load_error(const std::filesystem::path& file, const GltfOptions& options = {});

/// Whether a text holds another.
[[nodiscard]] bool contains(std::string_view text, std::string_view part);

/// Whether one of the warnings holds all parts.
[[nodiscard]] bool warns(const std::vector<std::string>& warnings,
                         const std::vector<std::string>& parts);

}  // namespace bdpt::io
