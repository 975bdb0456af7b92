#include "gltf/geometry/morph.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bdpt::io {

namespace {

/// Adds weight * displacements to the values. Displacements are empty if the target does not move
/// the attribute.
template <typename V>
void add(std::vector<V>& values, const std::vector<V>& displacements, float weight)
{
    for (std::size_t i = 0; i < displacements.size(); ++i) {
        values[i] += weight * displacements[i];
    }
}

}  // namespace

void apply_morph(MeshDesc& mesh, const PrimitiveReader& primitive, std::span<const double> weights,
                 LoadContext& context)
{
    const std::size_t targets = std::min(weights.size(), primitive.source().targets.size());
    const std::size_t vertices = mesh.positions.size();
    for (std::size_t t = 0; t < targets; ++t) {
        const auto weight = static_cast<float>(weights[t]);
        if (weight == 0.0f) {
            continue;
        }
        const auto read = [&]<typename V>(const char* semantic, V) {
            return primitive.read_target<V>(t, semantic, vertices, context);
        };
        add(mesh.positions, read("POSITION", Vec3()), weight);
        // A target cannot move attributes that the mesh itself does not have.
        if (!mesh.normals.empty()) {
            add(mesh.normals, read("NORMAL", Vec3()), weight);
        }
        if (!mesh.tangents.empty()) {
            const std::vector<Vec3> moved = read("TANGENT", Vec3());
            for (std::size_t i = 0; i < moved.size(); ++i) {
                mesh.tangents[i] += Vec4(weight * moved[i], 0.0f);  // the handedness is kept
            }
        }
        constexpr const char* coordinates[] = {"TEXCOORD_0", "TEXCOORD_1"};
        for (std::size_t set = 0; set < mesh.uvs.size(); ++set) {
            if (!mesh.uvs[set].empty()) {
                add(mesh.uvs[set], read(coordinates[set], Vec2()), weight);
            }
        }
        if (!mesh.colors.empty() && primitive.source().targets[t].contains("COLOR_0")) {
            const int accessor = primitive.source().targets[t].at("COLOR_0");
            const bool rgba =
                primitive.model().accessors[static_cast<std::size_t>(accessor)].type ==
                TINYGLTF_TYPE_VEC4;
            if (rgba) {
                add(mesh.colors, read("COLOR_0", Vec4()), weight);
            } else {
                const std::vector<Vec3> moved = read("COLOR_0", Vec3());
                for (std::size_t i = 0; i < moved.size(); ++i) {
                    mesh.colors[i] += Vec4(weight * moved[i], 0.0f);
                }
            }
        }
    }
}

}  // namespace bdpt::io
