#include "geometry/embree_scene.h"

#include "geometry/embree.h"
#include "geometry/placed_mesh.h"

#include <bdpt/error.h>

#include <cmath>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace bdpt {
namespace {

constexpr unsigned all_rays = 0xffffffffU;  // Embree 4 defaults to a mask of 1

template <auto release>
struct Releaser {
    template <typename T>
    void operator()(T* handle) const
    {
        release(handle);
    }
};

template <typename Handle, auto release>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Releaser<release>>;

using OwnedScene = Owned<RTCScene, rtcReleaseScene>;
using OwnedGeometry = Owned<RTCGeometry, rtcReleaseGeometry>;

/// Appends a float, because Embree reads whole 16-byte vectors.
std::vector<Vec3> padded(std::vector<Vec3> positions)
{
    positions.emplace_back(0.0f);
    return positions;
}

OwnedScene new_scene(RTCDevice device)
{
    OwnedScene scene(rtcNewScene(device));
    check_embree(device, "make a scene");
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // watertight
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
    return scene;
}

/// The owner of a query, passed to callbacks.
struct QueryOwner {
    const AnyHitFilter* filter;
    std::span<const PlacedMesh> placed;
};

/// Applies the filter to a hit. All queries are single rays, and packets of one have the layout of
/// the struct.
void filter_hit(const RTCFilterFunctionNArguments* args)
{
    if (args->valid[0] == 0) {
        return;
    }
    const embree::RayContext& query = embree::to_query(args->context);
    const auto& [filter, placed] = *static_cast<const QueryOwner*>(query.owner);
    const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
    const bool shared = hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    const std::uint32_t instance = shared ? hit.instID[0] : hit.geomID;
    TriangleHit at;
    placed[instance].hit(hit.primID, *query.ray, at);
    const AnyHit surface{.instance = instance,
                         .triangle = hit.primID,
                         .barycentrics = at.barycentrics,
                         .ng = at.ng,
                         .direction = query.ray->direction,
                         .segment = query.ray->segment};
    const bool passes = query.passage != nullptr
                            ? query.passage->passes(*filter, surface, RTCRayN_tfar(args->ray, 1, 0))
                            : surface.segment.at_surface(instance, hit.primID) >=
                                  filter->opacity(filter->owner, surface);
    if (passes) {
        args->valid[0] = 0;
    }
}

void let_pass(RTCDevice device, RTCGeometry geometry)
{
    if (rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED) == 0) {
        throw Error(
            ErrorCode::unsupported,
            "this Embree was built without filter functions, which surfaces need that let rays "
            "pass, by alpha or as clear glass");
    }
    rtcSetGeometryIntersectFilterFunction(geometry, &filter_hit);
    rtcSetGeometryOccludedFilterFunction(geometry, &filter_hit);
}

/// Vertices of a mesh, at one or more equally spaced times.
using PaddedPositions = std::vector<std::vector<Vec3>>;

/// Creates a triangle geometry. The vectors must outlive it.
OwnedGeometry new_triangles(RTCDevice device, const PaddedPositions& positions,
                            const std::vector<UVec3>& triangles, bool filtered)
{
    OwnedGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
    rtcSetGeometryTimeStepCount(geometry.get(), static_cast<unsigned>(positions.size()));
    for (std::size_t step = 0; step < positions.size(); ++step) {
        rtcSetSharedGeometryBuffer(
            geometry.get(), RTC_BUFFER_TYPE_VERTEX, static_cast<unsigned>(step), RTC_FORMAT_FLOAT3,
            positions[step].data(), 0, sizeof(Vec3), positions[step].size() - 1);
    }
    rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               triangles.data(), 0, sizeof(UVec3), triangles.size());
    rtcSetGeometryMask(geometry.get(), all_rays);
    if (filtered) {
        let_pass(device, geometry.get());
    }
    rtcCommitGeometry(geometry.get());
    check_embree(device, "take over a mesh");
    return geometry;
}

/// Returns all vertices in world space: at each step, if they move.
PaddedPositions world_positions(const PlacedMesh& placed)
{
    PaddedPositions result;
    const std::size_t vertices = placed.mesh().positions.size();
    for (std::size_t step = 0; step <= placed.steps(); ++step) {
        std::vector<Vec3> world;
        world.reserve(vertices + 1);
        for (std::size_t vertex = 0; vertex < vertices; ++vertex) {
            world.push_back(placed.world_point_at(step, vertex));
        }
        result.push_back(padded(std::move(world)));
    }
    return result;
}

OwnedGeometry new_instance(RTCDevice device, RTCScene mesh, const PlacedMesh& placed)
{
    OwnedGeometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(geometry.get(), mesh);
    rtcSetGeometryTimeStepCount(geometry.get(), static_cast<unsigned>(placed.steps() + 1));
    for (std::size_t step = 0; step <= placed.steps(); ++step) {
        rtcSetGeometryTransform(geometry.get(), static_cast<unsigned>(step),
                                RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &placed.transform_at(step)[0][0]);
    }
    rtcSetGeometryMask(geometry.get(), all_rays);
    rtcCommitGeometry(geometry.get());
    check_embree(device, "place a mesh");
    return geometry;
}

/// Tests the sum of the magnitudes, to need a single comparison.
bool is_within(Vec3 v, float bound)
{
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z) <= bound;
}

RTCRay to_embree(const Ray& ray)
{
    // A surface through the exact origin counts as behind it, as it is the surface that the ray
    // leaves.
    constexpr float beyond_origin = std::numeric_limits<float>::min();
    return {.org_x = ray.origin.x,
            .org_y = ray.origin.y,
            .org_z = ray.origin.z,
            .tnear = beyond_origin,
            .dir_x = ray.direction.x,
            .dir_y = ray.direction.y,
            .dir_z = ray.direction.z,
            .time = ray.segment.time,
            .tfar = ray.t_max,
            .mask = all_rays,
            .id = ray.ignored_sphere,
            .flags = 0};
}

/// The BVH of a mesh that instances share.
struct MeshTree {
    PaddedPositions positions;  // read by Embree
    OwnedScene scene;
};

MeshTree new_tree(RTCDevice device, const MeshDesc& desc, bool filtered)
{
    MeshTree tree;
    tree.positions.push_back(padded(desc.positions));
    tree.scene = new_scene(device);
    const OwnedGeometry geometry = new_triangles(device, tree.positions, desc.triangles, filtered);
    rtcAttachGeometryByID(tree.scene.get(), geometry.get(), 0);
    rtcCommitScene(tree.scene.get());
    check_embree(device, "build the BVH of a mesh");
    return tree;
}

}  // namespace

std::vector<bool> filtered_meshes(std::span<const InstanceDesc> instances, std::size_t mesh_count,
                                  const AnyHitFilter& filter)
{
    std::vector<bool> filtered(mesh_count, false);
    for (std::size_t i = 0; filter.concerns != nullptr && i < instances.size(); ++i) {
        const auto mesh = static_cast<std::size_t>(instances[i].mesh);
        filtered[mesh] =
            filtered[mesh] || filter.concerns(filter.owner, static_cast<std::uint32_t>(i));
    }
    return filtered;
}

struct EmbreeScene::State {
    std::shared_ptr<const EmbreeDevice> device;
    std::vector<bool> filtered;  // one per mesh
    // One per mesh; null for meshes in the top level.
    std::vector<std::shared_ptr<const MeshTree>> trees;
    std::vector<PaddedPositions> positions;  // vertices of the top level, in the format of Embree
    OwnedScene top;
    std::span<const PlacedMesh> placed;
    float reach = 0.0f;

    [[nodiscard]] float farthest_origin() const { return 8.0f * reach; }

    /// Tests whether a ray is valid. Embree may terminate the process for others, such as NaN from
    /// degenerate scenes; such rays hit nothing.
    [[nodiscard]] bool can_trace(const Ray& ray) const
    {
        return is_within(ray.origin, farthest_origin()) &&
               is_within(ray.direction, 16.0f * reach) && ray.t_max >= 0.0f;
    }

    /// Returns the BVH of `like` if it fits, else a new one.
    [[nodiscard]] std::shared_ptr<const MeshTree> find_tree(std::size_t mesh, const MeshDesc& desc,
                                                            const State* like) const
    {
        if (like != nullptr && like->trees[mesh] && like->filtered[mesh] == filtered[mesh]) {
            return like->trees[mesh];
        }
        return std::make_shared<const MeshTree>(new_tree(device->get(), desc, filtered[mesh]));
    }
};

EmbreeScene::EmbreeScene(std::span<const InstanceDesc> instances, std::span<PlacedMesh> placed,
                         std::size_t mesh_count, std::span<const Sphere> spheres,
                         const AnyHitFilter& any_hit_filter, Isa isa, const EmbreeScene* like)
    : filter_(any_hit_filter)
{
    const auto building = std::make_shared<State>();
    State& state = *building;
    const State* known = like != nullptr ? like->state_.get() : nullptr;
    state.device = known != nullptr ? known->device : std::make_shared<const EmbreeDevice>(isa);
    RTCDevice device = state.device->get();
    state.placed = placed;
    state.reach = compute_coordinate_limit(instances, mesh_count);
    state.filtered = filtered_meshes(instances, mesh_count, any_hit_filter);
    state.top = new_scene(device);

    std::vector<std::size_t> uses(mesh_count, 0);
    for (const InstanceDesc& instance : instances) {
        ++uses[static_cast<std::size_t>(instance.mesh)];
    }
    state.trees.resize(mesh_count);
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const auto mesh = static_cast<std::size_t>(instances[i].mesh);
        const MeshDesc& desc = placed[i].mesh();
        const auto id = static_cast<unsigned>(i);
        if (desc.triangles.empty()) {
            continue;
        }
        if (placed[i].deforms() || (uses[mesh] == 1 && !placed[i].moves())) {
            state.positions.push_back(world_positions(placed[i]));
            const PaddedPositions& world = state.positions.back();
            if (!placed[i].moves()) {
                placed[i].settle(world.front());
            }
            const OwnedGeometry geometry =
                new_triangles(device, world, desc.triangles, state.filtered[mesh]);
            rtcAttachGeometryByID(state.top.get(), geometry.get(), id);
            continue;
        }
        if (!state.trees[mesh]) {
            state.trees[mesh] = state.find_tree(mesh, desc, known);
        }
        const OwnedGeometry geometry =
            new_instance(device, state.trees[mesh]->scene.get(), placed[i]);
        rtcAttachGeometryByID(state.top.get(), geometry.get(), id);
    }
    if (!spheres.empty()) {
        const OwnedGeometry geometry(new_sphere_geometry(device, spheres));
        rtcSetGeometryMask(geometry.get(), all_rays);
        rtcCommitGeometry(geometry.get());
        check_embree(device, "take over the spheres");
        // The index after those of the instances identifies the spheres.
        rtcAttachGeometryByID(state.top.get(), geometry.get(),
                              static_cast<unsigned>(instances.size()));
    }
    rtcCommitScene(state.top.get());
    check_embree(device, "build the BVH of the scene");
    state_ = building;
}

EmbreeScene::EmbreeScene(const EmbreeScene& same, const AnyHitFilter& any_hit_filter)
    : state_(same.state_), filter_(any_hit_filter)
{}

EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene::~EmbreeScene() = default;

float EmbreeScene::farthest_origin() const noexcept
{
    return state_->farthest_origin();
}

Isa EmbreeScene::isa() const noexcept
{
    return state_->device->isa();
}

std::string EmbreeScene::embree_version() const
{
    return state_->device->version();
}

const std::vector<bool>& EmbreeScene::filtered() const noexcept
{
    return state_->filtered;
}

const void* EmbreeScene::tree(std::size_t mesh) const noexcept
{
    return state_->trees[mesh].get();
}

std::optional<RayHit> EmbreeScene::intersect(const Ray& ray, RayPassage* passage) const noexcept
{
    std::optional<RayHit> found;  // constructed in place of the result
    if (!state_->can_trace(ray)) [[unlikely]] {
        return found;
    }
    RTCRayHit query;  // Embree writes the rest of a hit
    query.ray = to_embree(ray);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    const QueryOwner owner{.filter = &filter_, .placed = state_->placed};
    embree::intersect(state_->top.get(), query, ray, &owner, passage);
    const RTCHit& hit = query.hit;
    if (hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return found;
    }
    if (passage != nullptr) [[unlikely]] {
        passage->set_end(query.ray.tfar);
    }
    found.emplace();
    const bool shared = hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
    const std::uint32_t instance = shared ? hit.instID[0] : hit.geomID;
    if (instance >= state_->placed.size()) {
        found->at.ng = {hit.Ng_x, hit.Ng_y, hit.Ng_z};
        found->sphere = hit.primID;
        return found;
    }
    found->instance = instance;
    found->triangle = hit.primID;
    state_->placed[instance].hit(hit.primID, ray, found->at);
    return found;
}

RayHit EmbreeScene::hit_at(const Ray& ray, const Crossing& crossing) const noexcept
{
    RayHit hit;
    hit.instance = crossing.instance;
    hit.triangle = crossing.triangle;
    state_->placed[crossing.instance].hit(crossing.triangle, ray, hit.at);
    return hit;
}

bool EmbreeScene::occluded(const Ray& ray, RayPassage* passage) const noexcept
{
    if (!state_->can_trace(ray)) [[unlikely]] {
        return true;  // An invalid ray transports no light.
    }
    RTCRay query = to_embree(ray);
    const QueryOwner owner{.filter = &filter_, .placed = state_->placed};
    embree::occluded(state_->top.get(), query, ray, &owner, passage);
    return query.tfar < 0.0f;
}

}  // namespace bdpt
