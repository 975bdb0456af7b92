#include "report/bench_text.h"

#include <bdpt/eval/bench/summary.h>
#include <bdpt/options/option_fields.h>
#include <fmt/core.h>

#include <string_view>

namespace bdpt::app {

std::string bench_text(const eval::SceneResult& scene, double seconds)
{
    std::string result = fmt::format("{}: {} x {} pixels, reference with relMSE {:.2g}\n",
                                     scene.name, scene.width, scene.height, scene.reference_noise);
    result += fmt::format("  {:<6}{:>8}{:>11}{:>24}{:>12}{:>12}\n", "", "samples", "relMSE",
                          "(least .. greatest)", "efficiency", "speed-up");
    for (const eval::IntegratorSummary& one : eval::summarize(scene, seconds)) {
        const eval::Spread& error = one.equal_time.error;
        const std::string range = fmt::format("({:.2e} .. {:.2e})", error.least, error.greatest);
        const std::string factor =
            one.speed_up ? fmt::format("{}{:.3g}x", one.speed_up->extrapolated ? "~" : "",
                                       one.speed_up->factor)
                         : "-";
        result +=
            fmt::format("  {:<6}{:>8}{:>11.2e}{:>24}{:>12.3g}{:>12}{}\n", to_name(one.integrator),
                        one.equal_time.samples, error.median, range, one.efficiency, factor,
                        one.equal_time.near_noise ? "  reference too noisy"
                        : one.floor               ? "  cannot find all light"
                                                  : "");
    }
    return result;
}

}  // namespace bdpt::app
