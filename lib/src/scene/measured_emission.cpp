#include "scene/measured_emission.h"

#include "math/rgb.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace bdpt {

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

}  // namespace bdpt
