#include "pilot/light_pilot.h"

#include "camera/camera.h"
#include "geometry/flush_denormals.h"
#include "integrator/sample_schedule.h"
#include "math/rgb.h"
#include "path/densities.h"
#include "path/direct_light.h"
#include "path/random_walk.h"
#include "pilot/pilot.h"
#include "pilot/pilot_constants.h"
#include "scene/light_set.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace bdpt {
namespace {

constexpr const LightPilotConstants& light_constants = pilot_constants.light;

/// Lights that next-event estimation treats as one: all with a position, or one at infinity.
struct Group {
    std::size_t lights = 0;
    double power = 0.0;  ///< probability by power
    double found = 0.0;
    std::size_t findings = 0;

    [[nodiscard]] double mean() const { return found / static_cast<double>(findings); }
};

}  // namespace

std::optional<AliasTable> learn_starts(std::span<const IndirectLight> found, const LightSet& lights)
{
    const NextEventLights& of_groups = lights.next_event_lights();
    std::vector<Group> groups(of_groups.group_count());
    std::vector<double> values(lights.size());
    double total = 0.0;
    for (const IndirectLight& finding : found) {
        const auto value = static_cast<double>(finding.value);
        Group& group = groups[of_groups.group(finding.light)];
        group.found += value;
        ++group.findings;
        values[static_cast<std::size_t>(finding.light)] += value;
        total += value;
    }
    if (!(total > 0.0)) {
        return std::nullopt;
    }
    for (std::uint32_t id = 0; id < lights.size(); ++id) {
        if (of_groups.has_power(LightId{id})) {
            Group& group = groups[of_groups.group(LightId{id})];
            ++group.lights;
            group.power += static_cast<double>(lights.emission_probability(LightId{id}));
        }
    }
    std::vector<float> probabilities(lights.size());
    for (std::uint32_t id = 0; id < lights.size(); ++id) {
        const auto power = static_cast<double>(lights.emission_probability(LightId{id}));
        if (!of_groups.has_power(LightId{id}) || !(power > 0.0)) {
            continue;
        }
        const Group& group = groups[of_groups.group(LightId{id})];
        const double by_power = power / group.power;
        double by_value = by_power;
        if (group.found > 0.0) {
            const double prior =
                light_constants.prior_findings * static_cast<double>(group.lights) * group.mean();
            by_value = (values[id] + prior * by_power) / (group.found + prior);
        }
        const double of_group =
            (1.0 - light_constants.power_part - light_constants.even_part) * group.found / total +
            light_constants.even_part / static_cast<double>(groups.size());
        const double within =
            (1.0 - light_constants.power_part) * by_value + light_constants.power_part * by_power;
        probabilities[id] =
            static_cast<float>(of_group * within + light_constants.power_part * power);
    }
    return AliasTable(probabilities);
}

namespace {

/// Results of a part of the pilot.
struct Finds {
    std::vector<EnvironmentVisibility::Trial> trials;
    std::vector<GroupShares::Finding> findings;
    std::vector<Escape> escapes;
    std::vector<Escape> to_suns;
    std::vector<IndirectLight> indirect;
};

/// Returns one kind of results of all parts, in their order.
template <typename Find>
std::vector<Find> concatenate(const std::vector<Finds>& parts, std::vector<Find> Finds::*kind)
{
    std::size_t size = 0;
    for (const Finds& part : parts) {
        size += (part.*kind).size();
    }
    std::vector<Find> all;
    all.reserve(size);
    for (const Finds& part : parts) {
        all.insert(all.end(), (part.*kind).begin(), (part.*kind).end());
    }
    return all;
}

/// Returns the environment; null if there is none, or it is black.
const EnvironmentLight* find_environment(const World& world)
{
    const auto id = world.lights().environment();
    return id && world.lights().next_event_lights().has_power(*id)
               ? &std::get<EnvironmentLight>(world.lights()[*id].model())
               : nullptr;
}

/// Tests whether there is a choice between groups that can be learned.
bool can_learn_groups(const World& world, const RenderOptions& options)
{
    const std::size_t groups = world.lights().next_event_lights().group_count();
    return groups > 1 && groups <= GroupShares::max_groups &&
           options.sampling.lights != LightSampling::power;
}

/// Returns the mesh that a light is a triangle of; null for other lights.
const PlacedMesh* mesh_of(const Light& light)
{
    const auto* triangle = std::get_if<TriangleLight>(&light.model());
    return triangle != nullptr ? &triangle->surface() : nullptr;
}

/// Tests whether there may be several lamps: lights that are not triangles of the same mesh, or
/// triangles of one that has more than a box and extends over much of the scene.
bool may_have_several_lamps(const World& world)
{
    const LightSet& lights = world.lights();
    std::optional<const PlacedMesh*> mesh;
    LightBounds all;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const Light& light = lights[LightId{i}];
        const auto bounds = light.bounds();
        if (!bounds || !lights.next_event_lights().has_power(LightId{i})) {
            continue;
        }
        if (mesh && (*mesh == nullptr || mesh_of(light) != *mesh)) {
            return true;
        }
        all = mesh ? merged(all, *bounds) : *bounds;
        mesh = mesh_of(light);
    }
    return lights.next_event_lights().placed_count() > light_constants.max_triangles_of_a_lamp &&
           distance(all.min, all.max) >
               light_constants.max_extent_of_a_lamp * 2.0f * world.bounding_sphere().radius;
}

/// Tests whether there is a choice between lights that light paths can learn. Takes a while if one
/// mesh has many lights.
bool can_learn_starts(const World& world, const RenderOptions& options)
{
    return can_learn_groups(world, options) ||
           (options.sampling.lights != LightSampling::power && may_have_several_lamps(world));
}

/// Returns the directional lights, up to a number beyond which they are not worth a ray each.
std::vector<LightId> find_suns(const World& world)
{
    std::vector<LightId> suns;
    for (const LightId id : world.lights().next_event_lights().infinite()) {
        if (std::holds_alternative<DirectionalLight>(world.lights()[id].model()) &&
            suns.size() < light_constants.max_suns) {
            suns.push_back(id);
        }
    }
    return suns;
}

/// Returns the visibility of the environment; nullopt if that does not help.
std::optional<EnvironmentVisibility> make_visibility(
    std::vector<EnvironmentVisibility::Trial> trials)
{
    const auto visible = std::count_if(trials.begin(), trials.end(),
                                       [](const auto& trial) { return trial.visible; });
    const double share = static_cast<double>(visible) / static_cast<double>(trials.size());
    if (trials.empty() || share < light_constants.min_visible ||
        share > light_constants.max_visible) {
        return std::nullopt;
    }
    return EnvironmentVisibility(std::move(trials));
}

/// Returns the shares of the groups; nullopt if no sample carried light.
std::optional<GroupShares> make_shares(std::vector<GroupShares::Finding> findings,
                                       const World& world)
{
    if (std::none_of(findings.begin(), findings.end(),
                     [](const auto& finding) { return finding.value > 0.0f; })) {
        return std::nullopt;
    }
    return GroupShares(std::move(findings), world.lights().next_event_lights().group_count());
}

/// Returns where light of the suns enters, for each sun that a ray of `to_suns` reached. The `tile`
/// of such a ray is the index of its sun in `find_suns`.
std::vector<SunEntries> make_sun_entries(const std::vector<Escape>& to_suns, const World& world)
{
    std::vector<SunEntries> entries;
    const std::vector<LightId> suns = find_suns(world);
    for (std::size_t sun = 0; sun < suns.size(); ++sun) {
        std::vector<Escape> of_sun;
        std::copy_if(to_suns.begin(), to_suns.end(), std::back_inserter(of_sun),
                     [sun](const Escape& escape) { return escape.tile == sun; });
        if (!of_sun.empty()) {
            entries.push_back({.sun = suns[sun],
                               .window = EntryWindow(of_sun, world.bounding_sphere().center,
                                                     world.bounding_sphere())});
        }
    }
    return entries;
}

/// Camera paths of one row of the pilot.
class LightPilotRow {
public:
    /// `learns_starts` is the result of `can_learn_starts`.
    LightPilotRow(const World& world, const MovingCamera& camera, const RenderOptions& options,
                  bool learns_starts)
        : world_(world),
          camera_(camera),
          options_(options),
          environment_(find_environment(world)),
          suns_(find_suns(world)),
          learns_groups_(can_learn_groups(world, options)),
          learns_starts_(learns_starts),
          path_(std::min(options.transport.max_depth, light_constants.edges) + 1)
    {}

    [[nodiscard]] Finds trace(int row)
    {
        const int side = light_pilot_side(options_);
        for (int column = 0; column < side; ++column) {
            Sampler sampler(SamplerKind::independent, light_constants.seed, column, row, 0);
            sampler.start(SampleUse::film);
            const Vec2 in_cell = sampler.next_2d();
            const Vec2 raster =
                (Vec2(column, row) + in_cell) *
                (Vec2(options_.film.width, options_.film.height) / static_cast<float>(side));
            const TimeAndWavelength moment = draw_time_and_wavelength(sampler, world_, camera_);
            const TimedCamera camera(camera_, moment.time);
            SampleContext sample{.world = world_,
                                 .camera = camera.get(),
                                 .sampler = sampler,
                                 .time = moment.time,
                                 .wavelength = moment.wavelength,
                                 .rays = rays_};
            trace_camera_subpath(sample, raster,
                                 {.max_vertices = path_.capacity(),
                                  .rr_start = options_.transport.rr_start,
                                  .rr_survival = options_.transport.rr_survival},
                                 path_);
            note_path(sample);
        }
        return std::move(contributions_);
    }

private:
    void note_path(SampleContext& sample)
    {
        note_escape();
        note_hits(sample);
        for (int t = 2; t <= path_.size(); ++t) {
            const PathVertex& vertex = path_[t - 1];
            if (!scatters(vertex.kind) || !vertex.connectible) {
                continue;
            }
            if (environment_ != nullptr && t < path_.size()) {
                const PathVertex& next = path_[t];
                const bool visible = next.kind == VertexKind::infinite;
                note(vertex, visible ? next.end.p : normalize(next.end.p - vertex.end.p), visible);
            }
            if (has_connectible(t - 1)) {  // next-event estimation finds direct light
                for (std::size_t sun = 0; sun < suns_.size(); ++sun) {
                    note_sun(sample, vertex, t, sun);
                }
            }
            sample.sampler.start(SampleUse::next_event, static_cast<std::uint32_t>(t));
            if (environment_ != nullptr) {
                sample_light(sample, t, {.id = *world_.lights().environment(), .probability = 1.0f},
                             1.0f);
            }
            if (learns_starts_) {
                sample_group(sample, vertex, t);
            }
        }
    }

    /// Tests whether light paths can be connected to one of the first `count` vertices.
    [[nodiscard]] bool has_connectible(int count) const
    {
        const auto first = path_.all().first(static_cast<std::size_t>(count));
        return std::any_of(first.begin(), first.end(), [](const PathVertex& vertex) {
            return scatters(vertex.kind) && vertex.connectible;
        });
    }

    /// Records that the path reached the environment after a vertex that is not specular: light
    /// paths cannot replace other paths.
    void note_escape()
    {
        const int last = path_.size() - 1;
        if (environment_ == nullptr || last < 1 || path_[last].kind != VertexKind::infinite ||
            !has_connectible(last)) {
            return;
        }
        const auto vertices = path_.all();
        const Vec3 direction = vertices.back().end.p;
        const float throughput = luminance(vertices.back().beta);
        if (std::isfinite(throughput)) {
            contributions_.escapes.push_back({.p = vertices[vertices.size() - 2].end.p,
                                              .direction = direction,
                                              .tile = environment_->tile_to(direction),
                                              .throughput = throughput});
        }
    }

    /// Records that light of a sun reaches the vertex.
    void note_sun(SampleContext& sample, const PathVertex& vertex, int t, std::size_t sun)
    {
        const LightId id = suns_[sun];
        const LightSet::NextEvent next{
            .light = id,
            .probability = 1.0f,
            .incident = world_.lights()[id].sample_incident(
                light_sample_context(vertex), Vec2(0.5f), EnvironmentSampling::plain, sample.time)};
        const DirectLight found =
            direct_light(sample, vertex.end, *vertex.bsdf, next, sample.segment(1, t));
        const float throughput = luminance(vertex.beta * found.f.f_cos);
        if (found.transmission && throughput > 0.0f && std::isfinite(throughput)) {
            contributions_.to_suns.push_back({.p = vertex.end.p,
                                              .direction = next.incident->wi,
                                              .tile = sun,
                                              .throughput = throughput});
        }
    }

    /// One group beside the environment.
    void sample_group(SampleContext& sample, const PathVertex& vertex, int t)
    {
        const NextEventLights& lights = world_.lights().next_event_lights();
        const auto others =
            static_cast<float>(lights.group_count() - (environment_ != nullptr ? 1U : 0U));
        auto group = static_cast<std::size_t>(others * sample.sampler.next_1d());
        if (environment_ != nullptr && group >= lights.group(*world_.lights().environment())) {
            ++group;
        }
        const auto chosen = lights.choose_of_group(group, light_sample_context(vertex),
                                                   fine_uniform(sample.sampler.next_fine()));
        if (chosen) {
            sample_light(sample, t, *chosen, others);
        } else {
            note_finding(vertex, static_cast<std::uint32_t>(group), 0.0f);
        }
    }

    /// Samples a light for the last of `t` vertices; its group was one of `groups`.
    void sample_light(SampleContext& sample, int t, NextEventLights::Choice chosen, float groups)
    {
        const auto [id, probability] = chosen;
        const PathVertex& vertex = path_[t - 1];
        const auto group =
            static_cast<std::uint32_t>(world_.lights().next_event_lights().group(id));
        const LightSet::NextEvent next{.light = id,
                                       .probability = probability,
                                       .incident = world_.lights()[id].sample_incident(
                                           light_sample_context(vertex), sample.sampler.next_2d(),
                                           EnvironmentSampling::compensated, sample.time)};
        DirectLight found;
        if (next.incident) {
            found = direct_light(sample, vertex.end, *vertex.bsdf, next, sample.segment(1, t));
        }
        if (world_.lights().environment() == id && !is_black(found.f.f_cos)) {
            note(vertex, next.incident->wi, found.transmission.has_value());
        }
        float value = 0.0f;
        if (!is_black(found.value) && learns_starts_) {
            // A BSDF sample may find the same light, and takes its share of the weight.
            const float density = next.incident->pdf_solid_angle.value;
            const float by_light = density * probability;
            value = luminance(found.value) * (by_light / (by_light + found.bsdf_pdf));
            if (has_connectible(t - 1)) {
                const float by_any = density * world_.lights().next_event_probability(
                                                   id, light_sample_context(vertex), unlearned);
                note_indirect(id, vertex.beta * found.value,
                              groups * (by_any / (by_any + found.bsdf_pdf)));
            }
        }
        note_finding(vertex, group, value);
    }

    /// Records the lights that the path hit after vertices which light paths can be connected to.
    void note_hits(SampleContext& sample)
    {
        for (int k = 2; learns_starts_ && k < path_.size(); ++k) {
            const PathVertex& x0 = path_[k];
            const PathVertex& x1 = path_[k - 1];
            if (x0.light && !is_black(x0.emission) && has_connectible(k - 1)) {
                const float by_light =
                    joinable(x1) ? next_event_density(sample, x0, x1, unlearned).value : 0.0f;
                note_indirect(*x0.light, x0.beta * x0.emission,
                              x0.pdf_fwd.value / (x0.pdf_fwd.value + by_light));
            }
        }
    }

    /// Records a contribution to the image and its MIS weight.
    void note_indirect(LightId id, Rgb contribution, float weight)
    {
        const float value = luminance(contribution) * weight;
        if (value > 0.0f && std::isfinite(value) &&
            world_.lights().next_event_lights().has_power(id)) {
            contributions_.indirect.push_back({.light = id, .value = value});
        }
    }

    void note_finding(const PathVertex& vertex, std::uint32_t group, float value)
    {
        if (learns_groups_ && std::isfinite(value)) {
            contributions_.findings.push_back({.p = vertex.end.p, .group = group, .value = value});
        }
    }

    void note(const PathVertex& vertex, Vec3 direction, bool visible)
    {
        contributions_.trials.push_back(
            {.p = vertex.end.p,
             .tile = static_cast<std::uint32_t>(environment_->tile_to(direction)),
             .visible = visible});
    }

    /// Densities of the pilot's light samples, but for the choice among groups: weights that are
    /// good enough to compare lights.
    static constexpr NextEventSampling unlearned{.environments = EnvironmentSampling::compensated,
                                                 .lights = LightSampling::tree};

    const World& world_;
    const MovingCamera& camera_;
    const RenderOptions& options_;
    const EnvironmentLight* environment_;  // if there is one
    std::vector<LightId> suns_;
    bool learns_groups_;
    bool learns_starts_;  // as well as groups, or without
    Subpath path_;
    RayCounts rays_;
    Finds contributions_;
};

}  // namespace

int light_pilot_side(const RenderOptions& options)
{
    const double pixels = static_cast<double>(options.film.width) * options.film.height;
    const double worth = std::sqrt(planned_paths(options) / light_constants.samples_per_path);
    if (worth < light_constants.min_side) {
        return 0;
    }
    return static_cast<int>(std::min(
        std::clamp<double>(std::sqrt(pixels), light_constants.min_side, light_constants.max_side),
        worth));
}

bool can_learn_light(const World& world, const RenderOptions& options)
{
    // In fog, points of segments are sampled for a light, without a receiver.
    return light_pilot_side(options) > 0 &&
           options.sampling.environment == EnvironmentSampling::learned &&
           options.integrator != IntegratorKind::pt && options.integrator != IntegratorKind::nee &&
           options.integrator != IntegratorKind::lt && options.transport.max_depth >= 2 &&
           (find_environment(world) != nullptr || can_learn_groups(world, options) ||
            (options.integrator != IntegratorKind::mis &&
             (can_learn_starts(world, options) || !find_suns(world).empty()))) &&
           world.media().fog() == MediumId::clear;
}

std::unique_ptr<const LearnedLight> learn_light(const World& world, const MovingCamera& camera,
                                                const RenderOptions& options,
                                                const std::stop_token& abandon)
{
    if (!can_learn_light(world, options)) {
        return nullptr;
    }
    const int side = light_pilot_side(options);
    const bool learns_starts = can_learn_starts(world, options);
    std::vector<Finds> rows(static_cast<std::size_t>(side));
    tbb::parallel_for(0, side, [&](int row) {
        if (abandon.stop_requested()) {
            return;
        }
        const FlushDenormals flush;
        rows[static_cast<std::size_t>(row)] =
            LightPilotRow(world, camera, options, learns_starts).trace(row);
    });
    if (abandon.stop_requested()) {
        return nullptr;
    }
    LearnedLight learned;
    tbb::parallel_invoke(
        [&] {
            learned.visibility = make_visibility(concatenate(rows, &Finds::trials));
            if (learned.visibility) {
                learned.entries.emplace(concatenate(rows, &Finds::escapes),
                                        find_environment(world)->tiles(), world.bounding_sphere());
            }
        },
        [&] { learned.groups = make_shares(concatenate(rows, &Finds::findings), world); },
        [&] { learned.starts = learn_starts(concatenate(rows, &Finds::indirect), world.lights()); },
        [&] { learned.suns = make_sun_entries(concatenate(rows, &Finds::to_suns), world); });
    return learned.visibility || learned.groups || learned.starts || !learned.suns.empty()
               ? std::make_unique<const LearnedLight>(std::move(learned))
               : nullptr;
}

}  // namespace bdpt
