#include "gltf/scene_builder.h"

#include "gltf/camera.h"
#include "gltf/image_table.h"
#include "gltf/light.h"
#include "gltf/material.h"
#include "gltf/mesh.h"
#include "gltf/model.h"
#include "gltf/placement.h"
#include "gltf/texture.h"
#include "gltf/transform.h"

#include <bdpt/error.h>

#include <fmt/format.h>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace bdpt::io {

namespace {

bool any_not_zero(const std::vector<double>& weights)
{
    return std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0.0; });
}

/// Flattens the node hierarchy of one scene.
class SceneBuilder {
public:
    SceneBuilder(const GltfModel& model, const ReadLimits& limits, Warnings& warnings)
        : model_(model.structs),
          limits_(limits),
          warnings_(warnings),
          images_(model, limits, result_.scene.images, warnings),
          textures_(model.structs, images_, warnings),
          visited_(model.structs.nodes.size(), false)
    {}

    [[nodiscard]] LoadedScene build(const std::vector<std::size_t>& roots)
    {
        struct Pending {
            std::size_t node;
            glm::dmat4 world_from_parent;
        };
        std::vector<Pending> stack;
        for (std::size_t i = roots.size(); i-- > 0;) {
            stack.push_back({roots[i], glm::dmat4(1.0)});
        }
        while (!stack.empty()) {
            const Pending next = stack.back();
            stack.pop_back();
            if (visited_[next.node]) {
                warnings_.add("the scene lists a node that it has already; it is shown once",
                              fmt::format("/nodes/{}", next.node));
                continue;
            }
            visited_[next.node] = true;
            const glm::dmat4 world =
                next.world_from_parent * local_transform(model_, next.node, warnings_);
            check_finite(world, next.node);
            add_node(next.node, world);
            const std::vector<int>& children = model_.nodes[next.node].children;
            for (std::size_t i = children.size(); i-- > 0;) {
                stack.push_back({static_cast<std::size_t>(children[i]), world});
            }
        }
        return std::move(result_);
    }

private:
    static void check_finite(const glm::dmat4& world, std::size_t node)
    {
        const Mat4 narrow(world);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 4; ++row) {
                if (!std::isfinite(narrow[column][row])) {
                    throw Error(
                        ErrorCode::invalid_input,
                        fmt::format("/nodes/{}: the transform to world space is not finite", node));
                }
            }
        }
    }

    void add_node(std::size_t node, const glm::dmat4& world)
    {
        if (std::optional<LightDesc> light = read_light(model_, node, world, warnings_)) {
            result_.scene.lights.push_back(std::move(*light));
        }
        if (std::optional<CameraDesc> camera = read_camera(model_, node, world, warnings_)) {
            result_.cameras.push_back(std::move(*camera));
        }
        const tinygltf::Node& source = model_.nodes[node];
        if (source.mesh < 0) {
            return;
        }
        const auto mesh = static_cast<std::size_t>(source.mesh);
        if (source.skin >= 0) {
            warnings_.add("a skinned mesh is shown in its bind pose",
                          fmt::format("/nodes/{}", node));
        }
        if (any_not_zero(source.weights) || any_not_zero(model_.meshes[mesh].weights)) {
            warnings_.add("morph targets are ignored", fmt::format("/nodes/{}", node));
        }
        for (std::size_t i = 0; i < model_.meshes[mesh].primitives.size(); ++i) {
            add_instance(node, {mesh, i}, world);
        }
    }

    void add_instance(std::size_t node, PrimitiveId id, const glm::dmat4& world)
    {
        const std::optional<MeshId> mesh = get_mesh(id);
        if (!mesh) {
            return;
        }
        if (result_.scene.instances.size() >= limits_.instances) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("/nodes: more than {} instances", limits_.instances));
        }
        const tinygltf::Node& source = model_.nodes[node];
        InstanceDesc instance;
        instance.name = source.name.empty() ? model_.meshes[id.mesh].name : source.name;
        instance.mesh = *mesh;
        instance.material = get_material(id);
        instance.world_from_object = Mat4(world);
        if (!std::isnormal(glm::determinant(Mat3(instance.world_from_object)))) {
            // A scale of zero flattens the mesh: its triangles may still be seen.
            std::optional<MeshDesc> flat =
                place_mesh(result_.scene.meshes[static_cast<std::size_t>(*mesh)], world);
            if (!flat) {
                warnings_.add("a mesh that is scaled to nothing is left out",
                              fmt::format("/nodes/{}", node));
                return;
            }
            warnings_.add("a mesh that is scaled flat gets the normals of its faces",
                          fmt::format("/nodes/{}", node));
            instance.mesh = add_mesh(std::move(*flat), id);
            instance.world_from_object = Mat4(1.0f);
        }
        result_.scene.instances.push_back(std::move(instance));
    }

    [[nodiscard]] MeshId add_mesh(MeshDesc mesh, PrimitiveId id)
    {
        triangles_ += mesh.triangles.size();
        if (triangles_ > limits_.triangles) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("{}: more than {} triangles", id.pointer(), limits_.triangles));
        }
        result_.scene.meshes.push_back(std::move(mesh));
        return static_cast<MeshId>(result_.scene.meshes.size() - 1);
    }

    [[nodiscard]] std::optional<MeshId> get_mesh(PrimitiveId id)
    {
        const auto [found, is_new] = meshes_.try_emplace({id.mesh, id.primitive});
        if (is_new) {
            if (std::optional<MeshDesc> mesh = read_primitive(model_, id, warnings_)) {
                found->second = add_mesh(std::move(*mesh), id);
            }
        }
        return found->second;
    }

    [[nodiscard]] MaterialId get_material(PrimitiveId id)
    {
        const int index = model_.meshes[id.mesh].primitives[id.primitive].material;
        const auto next = static_cast<MaterialId>(result_.scene.materials.size());
        const auto [found, is_new] = materials_.try_emplace(index, next);
        if (is_new) {
            // Without a material, that of the specification's defaults [glTF 2.0, sec. 3.7.2.1].
            result_.scene.materials.push_back(
                index < 0
                    ? MaterialDesc{}
                    : read_material(model_, static_cast<std::size_t>(index), textures_, warnings_));
        }
        return found->second;
    }

    const tinygltf::Model& model_;
    const ReadLimits& limits_;
    Warnings& warnings_;
    LoadedScene result_;
    ImageTable images_;
    TextureResolver textures_;
    std::vector<bool> visited_;
    std::map<std::pair<std::size_t, std::size_t>, std::optional<MeshId>> meshes_;
    std::map<int, MaterialId> materials_;
    std::uint64_t triangles_ = 0;
};

std::vector<std::size_t> find_roots(const tinygltf::Model& model, std::optional<std::size_t> scene)
{
    if (scene) {
        const std::vector<int>& nodes = model.scenes[*scene].nodes;
        return {nodes.begin(), nodes.end()};
    }
    std::vector<bool> has_parent(model.nodes.size(), false);
    for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
            has_parent[static_cast<std::size_t>(child)] = true;
        }
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < has_parent.size(); ++i) {
        if (!has_parent[i]) {
            roots.push_back(i);
        }
    }
    return roots;
}

}  // namespace

LoadedScene build_scene(CheckedGltf checked, std::optional<std::size_t> scene,
                        const ReadLimits& limits, Warnings& warnings)
{
    const GltfModel model = build_model(std::move(checked));
    return SceneBuilder(model, limits, warnings).build(find_roots(model.structs, scene));
}

}  // namespace bdpt::io
