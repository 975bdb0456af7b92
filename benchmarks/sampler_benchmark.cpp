// Measures the nanoseconds that the sampler takes per path vertex: a set of three numbers.

#include "math/sampler.h"

#include <benchmark/benchmark.h>

namespace {

using namespace bdpt;

/// Measures the latency as in a path: each vertex needs the numbers of the last one, so nothing
/// overlaps.
void walk_latency(benchmark::State& state, SamplerKind kind)
{
    constexpr std::uint32_t vertices = 8;
    std::int64_t index = 0;
    std::int64_t numbers = 0;
    for (auto _ : state) {
        Sampler sampler(kind, 7, 100, 200, index++);
        std::uint32_t carried = 0;
        float sum = 0.0f;
        for (std::uint32_t vertex = 0; vertex < vertices; ++vertex) {
            sampler.start(SampleUse::camera_walk, vertex + carried);
            const Vec2 u = sampler.next_2d();
            const float lobe = sampler.next_1d();
            sum += u.x + u.y + lobe;
            carried = sum < 0.0f ? 1U : 0U;
        }
        benchmark::DoNotOptimize(sum);
        numbers += 3 * vertices;
    }
    state.SetItemsProcessed(numbers);
}

/// Measures the throughput without dependencies, as when other work is in between.
void walk_throughput(benchmark::State& state, SamplerKind kind)
{
    constexpr std::uint32_t vertices = 8;
    std::int64_t index = 0;
    std::int64_t numbers = 0;
    for (auto _ : state) {
        Sampler sampler(kind, 7, 100, 200, index++);
        for (std::uint32_t vertex = 0; vertex < vertices; ++vertex) {
            sampler.start(SampleUse::camera_walk, vertex);
            benchmark::DoNotOptimize(sampler.next_2d());
            benchmark::DoNotOptimize(sampler.next_1d());
        }
        numbers += 3 * vertices;
    }
    state.SetItemsProcessed(numbers);
}

}  // namespace

BENCHMARK_CAPTURE(walk_latency, sobol, SamplerKind::sobol);
BENCHMARK_CAPTURE(walk_latency, independent, SamplerKind::independent);
BENCHMARK_CAPTURE(walk_throughput, sobol, SamplerKind::sobol);
BENCHMARK_CAPTURE(walk_throughput, independent, SamplerKind::independent);
BENCHMARK_MAIN();
