#include <bdpt/eval/verify.h>

#include "verify/evidence.h"
#include "verify/verdict.h"

#include <bdpt/error.h>
#include <bdpt/thread_limit.h>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::eval {
namespace {

constexpr std::int64_t min_batches = 8;

void require(bool holds, const char* what)
{
    if (!holds) {
        throw Error(ErrorCode::usage, std::string("verify: ") + what);
    }
}

void check_options(const VerifyOptions& options)
{
    constexpr int longest = 64;  // [edges]: the number of sums grows quadratically
    constexpr int widest = 4096;
    require(options.width >= 1 && options.width <= widest && options.height >= 1 &&
                options.height <= widest,
            "the image must have 1 to 4096 pixels along each side");
    require(options.grid >= 1 && options.grid <= std::min(options.width, options.height),
            "there must be 1 tile or more along each side, and not more than pixels");
    require(options.max_depth >= 1 && options.max_depth <= longest,
            "the longest path must have 1 to 64 edges");
    require(options.light_paths > 0.0 && options.light_paths <= 4096.0,
            "the number of light paths must be more than 0 and at most 4096");
    require(options.connections.value_or(0.0) >= 0.0 && options.connections.value_or(0.0) <= 4096.0,
            "the number of connections must be in [0, 4096]");
    require(options.connection_rays >= 0.0 && options.connection_rays <= 4096.0,
            "the number of connection rays must be in [0, 4096]");
    require(options.merge_radius.value_or(0.0) >= 0.0 && options.merge_radius.value_or(0.0) <= 1.0,
            "the merge radius must be in [0, 1]");
    require(options.light_samples >= 1 && options.light_samples <= 1024,
            "the number of light samples must be in [1, 1024]");
    require(options.false_alarm > 0.0 && options.false_alarm < 1.0,
            "the chance of a false alarm must be between 0 and 1");
    require(options.detectable_bias > 0.0, "the bias to detect must be greater than 0");
    require(options.seconds > 0.0, "the time must be greater than 0");
    require(options.max_batches >= 2, "there must be at least 2 batches");
    require(options.threads >= 0 && options.threads <= 4096,
            "the number of threads must be in [0, 4096]");
}

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

VerifyReport verify(const Scene& scene, const CameraDesc& camera, const VerifyOptions& options,
                    const VerifyControl& control)
{
    check_options(options);
    const auto start = std::chrono::steady_clock::now();
    const TileGrid grid(options.width, options.height, options.grid);
    Evidence evidence(grid, options.max_depth, count_of_others(options));
    const int threads = limit_threads(options.threads).allowed;
    // More threads than cores are allowed only on request.
    const tbb::global_control allowance(
        tbb::global_control::max_allowed_parallelism,
        std::max(static_cast<std::size_t>(threads),
                 tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)));
    tbb::task_arena arena(threads);

    // Sharpness is checked each time the number of batches has grown by a quarter. The check looks
    // at the noise, not at the difference, as p-values hold for a single look only.
    std::int64_t next_look = 32;
    double detectable = 1.0;
    while (evidence.batches() < options.max_batches) {
        const std::int64_t first = evidence.batches();
        const std::int64_t count =
            std::min({std::int64_t{2} * threads, options.max_batches - first, next_look - first});
        std::vector<std::optional<Batch>> batches(static_cast<std::size_t>(count));
        arena.execute([&] {
            tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t i) {
                batches[i].emplace(render_batch(scene, camera, options, grid,
                                                first + static_cast<std::int64_t>(i)));
            });
        });
        for (const std::optional<Batch>& batch : batches) {
            evidence.add(*batch);
        }
        if (evidence.batches() == next_look) {
            const VerifyReport so_far = judge(evidence, options);
            detectable = so_far.detectable;
            next_look += (next_look + 3) / 4;
            if (is_sharp(so_far, options)) {
                break;
            }
        }
        if (control.on_progress) {
            control.on_progress({.batches = evidence.batches(),
                                 .seconds = seconds_since(start),
                                 .detectable = detectable});
        }
        if (evidence.batches() >= min_batches &&
            (control.stop.stop_requested() || seconds_since(start) >= options.seconds)) {
            break;
        }
    }
    VerifyReport report = judge(evidence, options);
    report.seconds = seconds_since(start);
    return report;
}

}  // namespace bdpt::eval
