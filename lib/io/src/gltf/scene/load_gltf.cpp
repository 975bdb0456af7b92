#include <bdpt/io/gltf.h>

#include <bdpt/error.h>
#include <bdpt/motion.h>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "file/load_context.h"
#include "file/messages.h"
#include "gltf/animation/animation.h"
#include "gltf/animation/node_transforms.h"
#include "gltf/animation/steps.h"
#include "gltf/checks/checks.h"
#include "gltf/document/document.h"
#include "gltf/geometry/mesh_table.h"
#include "gltf/light_camera/light_camera.h"
#include "gltf/material/image_table.h"
#include "gltf/material/material.h"
#include "image/encoded_image.h"

namespace bdpt::io {
namespace {

/// Selected parts of a document, by index.
struct SceneChoice {
    std::optional<std::size_t> scene;     ///< none: all root nodes
    std::optional<std::size_t> variant;   ///< none: the materials of the primitives
    std::vector<std::size_t> animations;  ///< played one after the other; empty: nodes rest
    double time = 0.0;                    ///< time in the animations [s]
    Shutter shutter{};                    ///< relative to `time`
};

/// Tests whether the node and its descendants are visible [KHR_node_visibility].
bool is_visible(const tinygltf::Node& node)
{
    const auto found = node.extensions.find("KHR_node_visibility");
    return found == node.extensions.end() || !found->second.Has("visible") ||
           found->second.Get("visible").Get<bool>();
}

/// Flattens the node hierarchy of one scene.
class SceneBuilder {
public:
    /// `origin`: the world's origin in the coordinates of the file, if the scene needs one.
    SceneBuilder(const tinygltf::Model& model, const NodeMotion& motion,
                 std::optional<std::size_t> variant, const std::optional<DVec3>& origin,
                 LoadContext& context)
        : model_(model),
          motion_(motion),
          variant_(variant),
          context_(context),
          images_(model, result_.scene.images, context),
          profiles_(model, result_.scene.profiles, context),
          transforms_(model, origin.value_or(DVec3(0.0)), context),
          meshes_(model, transforms_, motion, result_.scene.meshes,
                  origin ? MeshTable::Storage::recentered : MeshTable::Storage::as_in_file,
                  context),
          visited_(model.nodes.size(), false)
    {
        result_.scene.origin = origin.value_or(DVec3(0.0));
    }

    [[nodiscard]] const SceneDesc& scene() const { return result_.scene; }

    /// Adds all but the materials.
    void add_nodes(const std::vector<std::size_t>& roots)
    {
        struct Pending {
            std::size_t node;
            bool visible;
        };
        std::vector<Pending> stack;
        for (std::size_t i = roots.size(); i-- > 0;) {
            stack.push_back({roots[i], true});
        }
        while (!stack.empty()) {
            const Pending next = stack.back();
            stack.pop_back();
            if (visited_[next.node]) {
                context_.warn("the scene lists a node twice; it is shown once",
                              fmt::format("/nodes/{}", next.node));
                continue;
            }
            visited_[next.node] = true;
            const tinygltf::Node& source = model_.nodes[next.node];
            const bool visible = next.visible && is_visible(source);
            add_camera(next.node);
            if (visible) {
                add_visible(next.node);
            }
            const std::vector<int>& children = source.children;
            for (std::size_t i = children.size(); i-- > 0;) {
                stack.push_back({static_cast<std::size_t>(children[i]), visible});
            }
        }
    }

    [[nodiscard]] LoadedScene finish(const std::function<void(const LoadProgress&)>& on_progress)
    {
        result_.scene.materials =
            read_materials(model_, wanted_materials_, images_, on_progress, context_);
        return std::move(result_);
    }

private:
    /// Adds the node's camera, which can be used even if the node is not visible.
    void add_camera(std::size_t node)
    {
        if (std::optional<CameraDesc> camera =
                read_camera(model_, node, transforms_.world(node), context_)) {
            camera->motion = camera_motion(motion_.world(node), node, context_);
            const auto index = static_cast<std::size_t>(model_.nodes[node].camera);
            const Mat4 turn(node_from_camera(model_.cameras[index]));
            for (Mat4& pose : camera->motion) {
                pose = pose * turn;
            }
            result_.cameras.push_back(std::move(*camera));
        }
    }

    void add_visible(std::size_t node)
    {
        const glm::dmat4& world = transforms_.world(node);
        if (std::optional<LightDesc> light = read_light(model_, node, world, context_)) {
            move_light(*light, motion_.world(node), node, context_);
            result_.scene.lights.push_back(std::move(*light));
        }
        if (std::optional<LightDesc> light = profiles_.read(node, world)) {
            move_light(*light, motion_.world(node), node, context_);
            result_.scene.lights.push_back(std::move(*light));
        }
        const tinygltf::Node& source = model_.nodes[node];
        if (source.mesh < 0) {
            return;
        }
        const std::vector<glm::dmat4> places = instance_transforms(
            model_, node, context_.limits.instances - result_.scene.instances.size(), context_);
        const auto mesh = static_cast<std::size_t>(source.mesh);
        for (std::size_t i = 0; i < model_.meshes[mesh].primitives.size(); ++i) {
            const std::optional<ShownMesh> shown = meshes_.get(node, i);
            if (!shown) {
                continue;
            }
            if (shown->in_world) {
                add_instance(node, {mesh, i}, shown->mesh, {glm::dmat4(1.0)});
                continue;
            }
            for (const glm::dmat4& place : places) {
                const bool is_centered = shown->center == DVec3(0.0);
                add_instance(
                    node, {mesh, i}, shown->mesh,
                    compute_worlds(node, is_centered ? place : glm::translate(place, shown->center),
                                   shown->mesh));
            }
        }
    }

    /// Returns the node's transforms of the mesh at each time, or a single one for all times.
    [[nodiscard]] std::vector<glm::dmat4> compute_worlds(std::size_t node, const glm::dmat4& place,
                                                         MeshId mesh)
    {
        const std::span<const glm::dmat4> moving = motion_.world(node);
        if (moving.empty()) {
            return {transforms_.world(node) * place};
        }
        std::vector<glm::dmat4> worlds;
        worlds.reserve(moving.size());
        for (const glm::dmat4& world : moving) {
            worlds.push_back(world * place);
        }
        // A mesh that deforms has all steps, so its instances must have them, too.
        const bool deforms = !result_.scene.meshes[static_cast<std::size_t>(mesh)].motion.empty();
        return deforms ? worlds : thinned(std::span<const glm::dmat4>(worlds));
    }

    /// Adds an instance. `worlds`: one transform for each time, or one for all.
    void add_instance(std::size_t node, PrimitiveId id, MeshId mesh,
                      const std::vector<glm::dmat4>& worlds)
    {
        if (result_.scene.instances.size() >= context_.limits.instances) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("/nodes: more than {} instances", context_.limits.instances));
        }
        const tinygltf::Node& source = model_.nodes[node];
        InstanceDesc instance;
        instance.name = source.name.empty() ? fmt::format("node_{}", node) : source.name;
        // Thousands of instances may share one name of any length.
        const std::string place = fmt::format("/nodes/{}", node);
        context_.budget.spend(place, 1, sizeof instance + instance.name.size());
        context_.budget.memory().spend(place, placed_instance + worlds.size() * sizeof(Mat4));
        instance.mesh = mesh;
        instance.material = get_material(id);
        for (const glm::dmat4& world : worlds) {
            if (!is_finite(Mat4(world))) {
                throw Error(
                    ErrorCode::invalid_input,
                    fmt::format("/nodes/{}: the transform of an instance is not finite", node));
            }
        }
        instance.world_from_object = Mat4(worlds.front());
        instance.motion.assign(worlds.begin() + 1, worlds.end());
        const float determinant = glm::determinant(Mat3(instance.world_from_object));
        if (!std::isnormal(determinant) || !can_move(instance.world_from_object, instance.motion)) {
            // A scale of zero flattens the mesh, whose triangles may still be visible.
            const std::optional<MeshId> flat = meshes_.flatten(mesh, id, worlds);
            if (!flat) {
                context_.warn("a mesh that is scaled to zero size is left out",
                              fmt::format("/nodes/{}", node));
                return;
            }
            context_.warn("a mesh that is scaled flat gets face normals",
                          fmt::format("/nodes/{}", node));
            instance.mesh = *flat;
            instance.world_from_object = Mat4(1.0f);
            instance.motion.clear();
        }
        result_.scene.instances.push_back(std::move(instance));
    }

    [[nodiscard]] MaterialId get_material(PrimitiveId id)
    {
        const tinygltf::Primitive& primitive = model_.meshes[id.mesh].primitives[id.primitive];
        const int index = variant_ ? variant_material(primitive, *variant_) : primitive.material;
        const auto next = static_cast<MaterialId>(wanted_materials_.size());
        const auto [found, is_new] = materials_.try_emplace(index, next);
        if (is_new) {
            wanted_materials_.push_back(index);
        }
        return found->second;
    }

    const tinygltf::Model& model_;
    const NodeMotion& motion_;
    std::optional<std::size_t> variant_;
    LoadContext& context_;
    LoadedScene result_;
    ImageTable images_;
    LightProfiles profiles_;
    NodeTransforms transforms_;
    MeshTable meshes_;
    std::vector<bool> visited_;
    std::map<int, MaterialId> materials_;  // by their index in the document
    std::vector<int> wanted_materials_;  // document indices, in the order of the scene's materials
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

/// Converts one scene of a document to a description and cameras; meshes, materials and images that
/// it does not use are left out. Throws `Error`.
LoadedScene build_scene(CheckedGltf checked, const SceneChoice& choice,
                        const std::function<void(const LoadProgress&)>& on_progress,
                        LoadContext& context)
{
    check_animations(JsonPlace(checked.document), choice.animations, context);
    tinygltf::Model model = build_model(std::move(checked), choice.animations);
    std::vector<AnimatedProperty> properties;
    for (const std::size_t animation : choice.animations) {
        std::vector<AnimatedProperty> more = read_animation(model, animation, context);
        std::move(more.begin(), more.end(), std::back_inserter(properties));
    }
    const double open = choice.time + choice.shutter.open;
    const double close = choice.time + choice.shutter.close;
    NodeMotion motion(model, properties, open, close, context);
    if (open < close && motion.steps() == 0 && !choice.animations.empty()) {
        context.warn("nothing moves while the shutter is open",
                     fmt::format("/animations: from {} s to {} s", open, close));
    }
    const std::vector<std::size_t> roots = find_roots(model, choice.scene);
    const DataBudget data = context.budget;
    const MemoryBudget memory = context.budget.memory();
    std::optional<SceneBuilder> builder(std::in_place, model, motion, choice.variant, std::nullopt,
                                        context);
    builder->add_nodes(roots);
    if (const std::optional<DVec3> origin = distant_origin(builder->scene())) {
        // Again, with coordinates that are subtracted in double precision before they are rounded.
        const Silence silence(context.warnings);
        context.budget = data;
        context.budget.memory() = memory;
        motion.set_origin(*origin);
        builder.emplace(model, motion, choice.variant, origin, context);
        builder->add_nodes(roots);
    }
    LoadedScene loaded = builder->finish(on_progress);
    if (choice.scene) {
        if (std::optional<EnvironmentLightDesc> environment =
                read_image_based_light(model, *choice.scene, context)) {
            loaded.scene.lights.emplace_back(std::move(*environment));
        }
    }
    return loaded;
}

/// Selects the scene that the user named or indexed, else the default one, else the first; none if
/// the document has no scenes. Throws `Error` (not_found) that lists the available scenes.
std::optional<std::size_t> select_scene(const Json& document,
                                        const std::optional<std::string>& wanted)
{
    const std::vector<std::string> names = names_in(document, "/scenes");
    if (wanted) {
        return select("scene", names, *wanted);
    }
    if (document.contains("scene")) {
        return document["scene"].get<std::size_t>();
    }
    return names.empty() ? std::nullopt : std::optional<std::size_t>(0);
}

LoadedScene load(const std::filesystem::path& file, const GltfOptions& options)
{
    LoadContext context{.folders = {.own = file.parent_path(), .allowed = options.allowed_folders},
                        .limits = options.limits,
                        .memory = options.memory};
    check_folders(context.folders);
    context.images = options.images.get();
    Ktx2Decoder ktx2(options.ktx_library);
    context.ktx2 = &ktx2;
    context.ignore_required = options.ignore_required;
    CheckedGltf checked = read_checked_gltf(file, context);
    GltfFacts facts = collect_facts(checked);
    facts.scene = select_scene(checked.document, options.scene);
    if (!facts.scene) {
        context.warn("the file has no scene; all its nodes are shown", "/scenes");
    }
    std::vector<std::filesystem::path> files = std::move(checked.files);
    SceneChoice choice;
    choice.scene = facts.scene;
    if (options.variant) {
        choice.variant = select("variant", facts.variant_names, *options.variant);
    }
    choice.animations = select_animations(facts.animation_names, options, context);
    choice.time = options.time.value_or(0.0);
    choice.shutter = options.shutter.value_or(Shutter{});
    LoadedScene loaded = build_scene(std::move(checked), choice, options.on_progress, context);
    loaded.facts = std::move(facts);
    loaded.files = std::move(files);
    if (options.strict) {
        context.warnings.refuse_harm();
    }
    loaded.warnings = context.warnings.lines();
    loaded.notes = context.warnings.drafts();
    return loaded;
}

}  // namespace

LoadedScene load_gltf(const std::filesystem::path& file, const GltfOptions& options)
{
    return with_named_errors(file, [&] { return load(file, options); });
}

}  // namespace bdpt::io
