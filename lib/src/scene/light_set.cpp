#include "scene/light_set.h"

#include "math/rgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

/// Emission of the emissive triangles of a scene. It depends on textures and vertex colours, not on
/// transforms, so a mesh with many instances is measured once for each of its materials.
class MeasuredEmission {
public:
    MeasuredEmission(std::span<const MaterialId> material_ids, std::span<const PlacedMesh> placed,
                     std::span<const Material> materials);

    /// Returns the emission of a triangle of an emissive instance.
    [[nodiscard]] const TriangleEmission& of(std::size_t instance, std::uint32_t triangle) const
    {
        return (*of_instance_[instance])[triangle];
    }

private:
    using Key = std::pair<const MeshDesc*, MaterialId>;

    std::map<Key, std::vector<TriangleEmission>> measured_;
    std::vector<const std::vector<TriangleEmission>*>
        of_instance_;  // one per instance; null: not emissive
};

MeasuredEmission::MeasuredEmission(std::span<const MaterialId> material_ids,
                                   std::span<const PlacedMesh> placed,
                                   std::span<const Material> materials)
    : of_instance_(material_ids.size(), nullptr)
{
    const int max_samples = max_emission_samples(material_ids, placed, materials);
    for (std::size_t i = 0; i < material_ids.size(); ++i) {
        const Material& material = materials[static_cast<std::size_t>(material_ids[i])];
        if (is_black(material.mean_emission())) {
            continue;
        }
        const auto [entry, is_new] = measured_.try_emplace({&placed[i].mesh(), material_ids[i]});
        std::vector<TriangleEmission>& all = entry->second;
        of_instance_[i] = &all;
        if (is_new) {
            const PlacedMesh& mesh = placed[i];
            all.resize(mesh.triangle_count());
            tbb::parallel_for(std::uint32_t{0}, mesh.triangle_count(), [&](std::uint32_t t) {
                all[t] = measure_emission(mesh, material, t, max_samples);
            });
        }
    }
}

/// Number of lights from which a tree is worth its time; docs/decisions/0033 has the figures.
constexpr std::size_t many_lights = 4;

/// Returns the sphere of a light, if it has one.
std::optional<Sphere> find_sphere(const LightDesc& desc)
{
    return std::visit(
        []<typename Kind>(const Kind& d) -> std::optional<Sphere> {
            if constexpr (std::constructible_from<SphereLight, const Kind&, std::uint32_t>) {
                if (d.radius > 0.0f) {
                    return Sphere{.center = d.position, .radius = d.radius, .motion = d.motion};
                }
            }
            return std::nullopt;
        },
        desc);
}

std::size_t emissive_triangles(std::span<const MaterialId> material_ids,
                               std::span<const PlacedMesh> placed,
                               std::span<const Material> materials)
{
    std::size_t count = 0;
    for (std::size_t i = 0; i < material_ids.size(); ++i) {
        const Material& material = materials[static_cast<std::size_t>(material_ids[i])];
        count += is_black(material.mean_emission()) ? 0U : placed[i].triangle_count();
    }
    return count;
}

AliasTable powers(const std::vector<Light>& lights)
{
    std::vector<float> luminances;
    luminances.reserve(lights.size());
    for (const Light& light : lights) {
        luminances.push_back(luminance(light.power()));
    }
    return AliasTable(luminances);
}

}  // namespace

int max_emission_samples(std::span<const MaterialId> material_ids,
                         std::span<const PlacedMesh> placed, std::span<const Material> materials)
{
    constexpr double budget = 0x1p18;
    std::set<std::pair<const MeshDesc*, MaterialId>> counted;
    std::size_t textured = 0;
    for (std::size_t i = 0; i < material_ids.size(); ++i) {
        const bool counts =
            materials[static_cast<std::size_t>(material_ids[i])].emission_needs_texture() &&
            counted.insert({&placed[i].mesh(), material_ids[i]}).second;
        textured += counts ? placed[i].triangle_count() : 0U;
    }
    const double each = budget / static_cast<double>(std::max<std::size_t>(textured, 1));
    return static_cast<int>(std::clamp(std::sqrt(each), 8.0, 1024.0));
}

std::vector<Sphere> light_spheres(std::span<const LightDesc> lights)
{
    std::vector<Sphere> spheres;
    for (const LightDesc& desc : lights) {
        if (const auto sphere = find_sphere(desc)) {
            spheres.push_back(*sphere);
        }
    }
    return spheres;
}

LightSet::LightSet(std::span<const MaterialId> material_ids, std::span<const PlacedMesh> placed,
                   std::span<const Material> materials, std::span<const LightDesc> lights,
                   std::span<const IntensityProfile> profiles, const BoundingSphere& bounds,
                   std::span<const MediumId> media)
    : bounds_(bounds), first_of_instance_(material_ids.size())
{
    const MeasuredEmission emission(material_ids, placed, materials);
    lights_.reserve(lights.size() + emissive_triangles(material_ids, placed, materials));
    for (std::size_t i = 0; i < material_ids.size(); ++i) {
        const Material& material = materials[static_cast<std::size_t>(material_ids[i])];
        if (is_black(material.mean_emission())) {
            continue;
        }
        first_of_instance_[i] = static_cast<std::uint32_t>(lights_.size());
        for (std::uint32_t t = 0; t < placed[i].triangle_count(); ++t) {
            lights_.emplace_back(TriangleLight(placed[i], material, t, emission.of(i, t)));
        }
    }
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const LightDesc& desc = lights[i];
        const LightId id{static_cast<std::uint32_t>(lights_.size())};
        lights_.emplace_back(desc,
                             LightContext{.profiles = profiles,
                                          .bounds = bounds,
                                          .sphere = static_cast<std::uint32_t>(spheres_.size()),
                                          .medium = media[i]});
        if (std::holds_alternative<EnvironmentLightDesc>(desc)) {
            environment_ = id;
        }
        if (std::holds_alternative<SphereLight>(lights_.back().model())) {
            spheres_.push_back(id);
        }
    }
    by_power_ = powers(lights_);
    next_event_ = NextEventLights(lights_);
    // The power of light from infinity grows with the size of the scene, not with its contribution
    // to a point: besides the sun, a local light in a large scene would never be chosen by power.
    prefers_tree_ = next_event_.placed_count() >= many_lights || next_event_.has_both_kinds();
}

std::optional<LightSet::Choice> LightSet::choose(const AliasTable& table, Vec2 u)
{
    if (table.empty()) {
        return std::nullopt;
    }
    const auto choice = table.sample(fine_uniform(u));
    return Choice{.id = LightId{choice.index}, .probability = choice.probability};
}

namespace {

/// Returns where light of a sun enters the scene, as learned; null if that is unknown.
const EntryWindow* learned_window(LightId id, const LearnedLight* learned)
{
    if (learned != nullptr) {
        for (const SunEntries& entries : learned->suns) {
            if (entries.sun == id) {
                return &entries.window;
            }
        }
    }
    return nullptr;
}

}  // namespace

const EnvironmentEntries* LightSet::learned_entries(LightId id, const LearnedLight* learned) const
{
    return environment_ == id && learned != nullptr && learned->entries ? &*learned->entries
                                                                        : nullptr;
}

std::optional<EmissionSample> LightSet::sample_emission(const ChoiceAndNumbers& choice,
                                                        Vec2 u_direction,
                                                        const LearnedLight* learned,
                                                        float time) const
{
    const Light& light = (*this)[choice.id];
    if (const EnvironmentEntries* entries = learned_entries(choice.id, learned)) {
        return std::get<EnvironmentLight>(light.model())
            .sample_emission(choice.u, u_direction, *entries);
    }
    if (const EntryWindow* window = learned_window(choice.id, learned)) {
        return std::get<DirectionalLight>(light.model()).sample_emission(choice.u, time, *window);
    }
    return light.sample_emission(choice.u, u_direction, time);
}

LightSet::EmissionPdfs LightSet::emission_pdfs(LightId id, const LightPoint& x0, Vec3 p,
                                               Vec3 to_light, const LearnedLight* learned) const
{
    const Light& light = (*this)[id];
    const float chosen = emission_probability(id, learned);
    if (const EnvironmentEntries* entries = learned_entries(id, learned)) {
        const auto pdf =
            std::get<EnvironmentLight>(light.model()).pdf_emission(to_light, p, *entries);
        return {.position = pdf.direction * chosen, .direction = {}, .entry = pdf.entry};
    }
    const AreaPdf position = light.pdf_position(x0) * chosen;
    if (!light.is_infinite()) {
        return {.position = position,
                .direction = light.pdf_direction(x0.ng, -to_light, x0.time),
                .entry = {}};
    }
    const EntryWindow* window = learned_window(id, learned);
    return {.position = position,
            .direction = {},
            .entry = window != nullptr ? window->pdf(p, -to_light) : bounds_.pdf_disk()};
}

std::optional<LightId> LightSet::of_triangle(std::uint32_t instance, std::uint32_t triangle) const
{
    const auto& first = first_of_instance_[instance];
    if (!first) {
        return std::nullopt;
    }
    return LightId{*first + triangle};
}

}  // namespace bdpt
