#include <bdpt/options/integrators.h>
#include <bdpt/options/option_fields.h>

#include "integrator/bidirectional/bidirectional_integrator.h"
#include "integrator/integrator.h"
#include "integrator/path/path_integrator.h"

#include <algorithm>
#include <array>

namespace bdpt {
namespace {

using Factory = std::unique_ptr<Integrator> (*)(const World&, const MovingCamera&,
                                                const RenderOptions&, const LearnedLight*);

template <typename T>
std::unique_ptr<Integrator> make(const World& world, const MovingCamera& camera,
                                 const RenderOptions& options, const LearnedLight* learned)
{
    return std::make_unique<T>(world, camera, options, learned);
}

/// User-facing description and factory of an integrator.
struct Row {
    IntegratorInfo info;
    Factory make;
};

/// Sorted from the simplest to the one with all strategies, and the automatic choice.
constexpr std::array table{
    Row{{.kind = IntegratorKind::pt,
         .name = to_name(IntegratorKind::pt),
         .summary = "path tracing, BSDF sampling only",
         .traces_light_paths = false,
         .has_strategies = false},
        &make<PathIntegrator>},
    Row{{.kind = IntegratorKind::nee,
         .name = to_name(IntegratorKind::nee),
         .summary = "path tracing, light sampling only",
         .traces_light_paths = false,
         .has_strategies = false},
        &make<PathIntegrator>},
    Row{{.kind = IntegratorKind::mis,
         .name = to_name(IntegratorKind::mis),
         .summary = "path tracing with light and BSDF sampling",
         .traces_light_paths = false,
         .has_strategies = false},
        &make<PathIntegrator>},
    Row{{.kind = IntegratorKind::lt,
         .name = to_name(IntegratorKind::lt),
         .summary = "light tracing",
         .traces_light_paths = true,
         .has_strategies = true},
        &make<BidirectionalIntegrator>},
    Row{{.kind = IntegratorKind::bdpt,
         .name = to_name(IntegratorKind::bdpt),
         .summary = "bidirectional path tracing",
         .traces_light_paths = true,
         .has_strategies = true},
        &make<BidirectionalIntegrator>},
    Row{{.kind = IntegratorKind::vcm,
         .name = to_name(IntegratorKind::vcm),
         .summary = "vertex connection and merging (biased, but consistent)",
         .traces_light_paths = true,
         .has_strategies = false,
         .biased = true},
        &make<BidirectionalIntegrator>},
    Row{{.kind = IntegratorKind::automatic,
         .name = to_name(IntegratorKind::automatic),
         .summary = "mis, or bdpt with suitable numbers of light paths and connections, chosen by "
                    "a short test render",
         .traces_light_paths = true,
         .has_strategies = true},
        nullptr},  // `chosen_options` replaces it
};

const Row& find_row(IntegratorKind kind)
{
    return *std::find_if(table.begin(), table.end(),
                         [kind](const Row& row) { return row.info.kind == kind; });
}

/// The descriptions without factories.
constexpr auto infos = [] {
    std::array<IntegratorInfo, table.size()> result{};
    std::transform(table.begin(), table.end(), result.begin(),
                   [](const Row& row) { return row.info; });
    return result;
}();

}  // namespace

std::span<const IntegratorInfo> integrators()
{
    return infos;
}

const IntegratorInfo& info(IntegratorKind kind)
{
    return find_row(kind).info;
}

std::unique_ptr<Integrator> make_integrator(const World& world, const MovingCamera& camera,
                                            const RenderOptions& options,
                                            const LearnedLight* learned)
{
    return find_row(options.integrator).make(world, camera, options, learned);
}

}  // namespace bdpt
