#include "gltf/geometry/mesh.h"

#include "gltf/document/document.h"

#include <bdpt/error.h>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace bdpt::io {

namespace {

/// The matrix that moves a vertex, while it is summed up.
struct Blend {
    glm::dmat4 sum{0.0};
    double weight = 0.0;
};

/// Adds set `n` of joints and weights; returns false if there is no such set.
bool add_set(std::vector<Blend>& blends, const PrimitiveReader& primitive, int n,
             std::span<const glm::dmat4> joints, LoadContext& context)
{
    const std::string joint_name = fmt::format("JOINTS_{}", n);
    const std::string weight_name = fmt::format("WEIGHTS_{}", n);
    const std::vector<Vec4> indices =
        primitive.read<Vec4>(joint_name, blends.size(), context, Integers::whole);
    const std::vector<Vec4> weights =
        primitive.read<Vec4>(weight_name, blends.size(), context, Integers::normalized);
    if (indices.empty() || weights.empty()) {
        return false;
    }
    for (std::size_t i = 0; i < blends.size(); ++i) {
        for (int c = 0; c < 4; ++c) {
            const double weight = static_cast<double>(weights[i][c]);
            if (!std::isfinite(weight) || weight < 0.0) {
                context.warn("invalid joint weights are treated as 0",
                             fmt::format("{}/attributes/{}: vertex {}: {}",
                                         primitive.id().pointer(), weight_name, i, weight));
                continue;
            }
            if (weight == 0.0) {
                continue;  // Exporters write arbitrary joints for a weight of 0.
            }
            const float joint = indices[i][c];
            if (!(joint >= 0.0f && joint < static_cast<float>(joints.size()))) {
                primitive.fail("attributes/" + joint_name,
                               fmt::format("vertex {}: joint {}, but the skin has {}", i, joint,
                                           joints.size()));
            }
            blends[i].sum += weight * joints[static_cast<std::size_t>(joint)];
            blends[i].weight += weight;
        }
    }
    return true;
}

std::vector<Blend> blend_joints(const PrimitiveReader& primitive, std::size_t vertices,
                                std::span<const glm::dmat4> joints, LoadContext& context)
{
    std::vector<Blend> blends(vertices);
    for (int n = 0; add_set(blends, primitive, n, joints, context); ++n) {
    }
    // Eight weights of 8 bits may legitimately be off by this.
    constexpr double tolerance = 8.0 * 0.5 / 255.0;
    for (std::size_t i = 0; i < vertices; ++i) {
        Blend& blend = blends[i];
        if (!(std::abs(blend.weight - 1.0) <= tolerance)) {
            context.warn(blend.weight > 0.0
                             ? "joint weights that do not sum to 1 are normalised"
                             : "vertices without a weight follow the first joint of their skin",
                         fmt::format("{}/attributes/WEIGHTS_0: vertex {}: {}",
                                     primitive.id().pointer(), i, blend.weight));
        }
        blend.sum = blend.weight > 0.0 ? blend.sum / blend.weight : joints.front();
    }
    return blends;
}

/// Returns the matrix for normals: the inverse transpose up to a positive factor, which also exists
/// for singular matrices.
glm::dmat3 normal_matrix(const glm::dmat3& m)
{
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    return glm::determinant(m) < 0.0 ? -cofactors : cofactors;
}

/// Normalizes `v`; zero if it has no direction.
glm::dvec3 direction(const glm::dvec3& v)
{
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

}  // namespace

bool has_joints(const PrimitiveReader& primitive)
{
    return primitive.attribute("JOINTS_0") && primitive.attribute("WEIGHTS_0");
}

std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, int skin,
                                       NodeTransforms& transforms, const NodeMotion& motion,
                                       std::size_t step, LoadContext& context)
{
    const tinygltf::Skin& source = model.skins[static_cast<std::size_t>(skin)];
    const std::string place = fmt::format("/skins/{}", skin);
    context.budget.spend(place, source.joints.size(), sizeof(glm::dmat4));
    std::vector<glm::dmat4> matrices;
    matrices.reserve(source.joints.size());
    for (const int joint : source.joints) {
        const auto node = static_cast<std::size_t>(joint);
        const std::span<const glm::dmat4> moving = motion.world(node);
        matrices.push_back(moving.empty() ? transforms.world(node) : moving[step]);
    }
    const int accessor = source.inverseBindMatrices;
    if (accessor < 0) {
        return matrices;
    }
    constexpr std::size_t size = 16;
    context.budget.spend(place, model.accessors[static_cast<std::size_t>(accessor)].count,
                         size * sizeof(float));
    const std::vector<float> values = read_numbers(model, accessor, TINYGLTF_TYPE_MAT4);
    if (values.size() / size < matrices.size()) {
        throw Error(
            ErrorCode::invalid_input,
            fmt::format("{}/inverseBindMatrices: {} matrices, but the number of joints is {}",
                        place, values.size() / size, matrices.size()));
    }
    for (std::size_t i = 0; i < matrices.size(); ++i) {
        matrices[i] *= glm::dmat4(glm::make_mat4(values.data() + i * size));
    }
    return matrices;
}

bool moves(const tinygltf::Skin& skin, const NodeMotion& motion)
{
    return std::any_of(skin.joints.begin(), skin.joints.end(), [&motion](int joint) {
        return !motion.world(static_cast<std::size_t>(joint)).empty();
    });
}

void apply_skin(MeshDesc& mesh, const PrimitiveReader& primitive,
                std::span<const glm::dmat4> joints, LoadContext& context)
{
    if (joints.empty()) {
        return;
    }
    const std::vector<Blend> blends =
        blend_joints(primitive, mesh.positions.size(), joints, context);
    std::vector<double> determinants;
    determinants.reserve(blends.size());
    for (std::size_t i = 0; i < blends.size(); ++i) {
        const glm::dmat4& matrix = blends[i].sum;
        const glm::dmat3 linear(matrix);
        determinants.push_back(glm::determinant(linear));
        mesh.positions[i] = Vec3(matrix * glm::dvec4(glm::dvec3(mesh.positions[i]), 1.0));
        if (!mesh.normals.empty()) {
            mesh.normals[i] = Vec3(direction(normal_matrix(linear) * glm::dvec3(mesh.normals[i])));
        }
        if (!mesh.tangents.empty()) {
            const Vec4& tangent = mesh.tangents[i];
            mesh.tangents[i] = Vec4(Vec3(direction(linear * glm::dvec3(tangent))),
                                    determinants[i] < 0.0 ? -tangent.w : tangent.w);
        }
    }
    for (UVec3& triangle : mesh.triangles) {
        const double mirrored =
            determinants[triangle.x] + determinants[triangle.y] + determinants[triangle.z];
        if (mirrored < 0.0) {
            std::swap(triangle.y, triangle.z);
        }
    }
}

}  // namespace bdpt::io
