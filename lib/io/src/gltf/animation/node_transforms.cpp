#include "gltf/animation/node_transforms.h"

#include <bdpt/error.h>
#include <bdpt/types.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace bdpt::io {

namespace {

glm::dmat4 from_matrix(const std::vector<double>& values, const std::string& place,
                       LoadContext& context)
{
    glm::dmat4 matrix = glm::make_mat4(values.data());
    for (int column = 0; column < 4; ++column) {
        const double wanted = column == 3 ? 1.0 : 0.0;
        if (matrix[column][3] != wanted) {
            context.warn("the last row of a matrix is taken as 0 0 0 1", place + "/matrix");
            matrix[column][3] = wanted;
        }
    }
    return matrix;
}

/// Returns the cube root of x >= 0. The C library's may differ between machines.
double cube_root(double x)
{
    if (!(x > 0.0) || !std::isfinite(x)) {
        return x;
    }
    int exponent = 0;
    double rest = std::frexp(x, &exponent);
    const int third = exponent / 3;
    rest = std::ldexp(rest, exponent - 3 * third);  // in [1/8, 4)
    // Newton's method: from 1.2, eight steps suffice for the whole range.
    double root = 1.2;
    for (int step = 0; step < 8; ++step) {
        root = (2.0 * root + rest / (root * root)) / 3.0;
    }
    return std::ldexp(root, third);
}

}  // namespace

glm::dmat4 local_transform(const tinygltf::Model& model, std::size_t node, LoadContext& context)
{
    const tinygltf::Node& source = model.nodes[node];
    const std::string place = fmt::format("/nodes/{}", node);
    if (!source.matrix.empty()) {
        return from_matrix(source.matrix, place, context);
    }
    glm::dmat4 transform(1.0);
    if (!source.translation.empty()) {
        transform = glm::translate(transform, glm::make_vec3(source.translation.data()));
    }
    if (!source.rotation.empty()) {
        transform = transform * rotation(source.rotation, place, context);
    }
    if (!source.scale.empty()) {
        transform = glm::scale(transform, glm::make_vec3(source.scale.data()));
    }
    return transform;
}

Vec3 transform_direction(const glm::dmat4& world_from_node, const glm::dvec3& direction)
{
    const glm::dvec3 turned = glm::dmat3(world_from_node) * direction;
    const double length = glm::length(turned);
    if (!(length > 0.0) || !std::isfinite(length)) {
        return {0.0f, 0.0f, -1.0f};
    }
    return Vec3(turned / length);
}

glm::dmat4 rotation(const std::vector<double>& xyzw, const std::string& place, LoadContext& context)
{
    const glm::dquat given(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    const double length = glm::length(given);
    // Deviations of single-precision values and a few digits of text are not reported.
    constexpr double tolerance = 1e-3;
    if (std::abs(length - 1.0) > tolerance) {
        context.warn(length > 0.0 ? "a rotation that is not of unit length is normalised"
                                  : "a rotation of length 0 is ignored",
                     fmt::format("{}/rotation: length {}", place, length));
    }
    return length > 0.0 ? glm::mat4_cast(given / length) : glm::dmat4(1.0);
}

Mat3 compute_axes(const glm::dmat4& world_from_node)
{
    const glm::dmat3 m(world_from_node);
    const glm::dvec3 z(-transform_direction(world_from_node, {0.0, 0.0, -1.0}));
    // If the transform maps x to zero or onto z, any axis will do.
    glm::dvec3 x = m[0] - glm::dot(m[0], z) * z;
    if (!(glm::length(x) > 1e-9 * glm::length(m[0])) || !std::isfinite(glm::length(x))) {
        const glm::dvec3 other = std::abs(z.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        x = other - glm::dot(other, z) * z;
    }
    x = glm::normalize(x);
    const double side = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
    return Mat3(Vec3(x), Vec3(side * glm::cross(z, x)), Vec3(z));
}

bool is_finite(const Mat4& matrix)
{
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row])) {
                return false;
            }
        }
    }
    return true;
}

double mean_scale(const glm::dmat4& world_from_node)
{
    return cube_root(std::abs(glm::determinant(glm::dmat3(world_from_node))));
}

namespace {

constexpr std::size_t no_node = static_cast<std::size_t>(-1);

void check_finite(const glm::dmat4& world, std::size_t node)
{
    if (!is_finite(Mat4(world))) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("/nodes/{}: the transform to world space is not finite", node));
    }
}

}  // namespace

NodeTransforms::NodeTransforms(const tinygltf::Model& model, const DVec3& origin,
                               LoadContext& context)
    : model_(model),
      origin_(origin),
      context_(context),
      parents_(model.nodes.size(), no_node),
      world_(model.nodes.size())
{
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        for (const int child : model.nodes[i].children) {
            parents_[static_cast<std::size_t>(child)] = i;
        }
    }
}

const glm::dmat4& NodeTransforms::world(std::size_t node)
{
    std::vector<std::size_t> unknown;  // from the node upwards
    for (std::size_t i = node; i != no_node && !world_[i]; i = parents_[i]) {
        unknown.push_back(i);
    }
    for (; !unknown.empty(); unknown.pop_back()) {
        const std::size_t i = unknown.back();
        const std::size_t parent = parents_[i];
        const glm::dmat4 local = local_transform(model_, i, context_);
        glm::dmat4 world = parent == no_node ? local : *world_[parent] * local;
        if (parent == no_node) {
            world[3] -= glm::dvec4(origin_, 0.0);
        }
        check_finite(world, i);
        world_[i] = world;
    }
    return *world_[node];
}

}  // namespace bdpt::io
