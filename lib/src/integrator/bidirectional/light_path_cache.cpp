#include "integrator/bidirectional/light_path_cache.h"

#include "integrator/bidirectional/light_vertex_grid.h"
#include "math/elementary.h"
#include "math/random_numbers.h"
#include "math/sampler.h"
#include "path/strategy_set.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace bdpt {

void LightVertexBlock::set(std::size_t i, std::span<const PathVertex> light, double count)
{
    const PathVertex& vertex = light.back();
    const auto normal = vertex.bsdf->opaque_normal();
    const Vec3 n = normal.value_or(Vec3(0.0f));
    x[i] = vertex.end.p.x;
    y[i] = vertex.end.p.y;
    z[i] = vertex.end.p.z;
    nx[i] = n.x;
    ny[i] = n.y;
    nz[i] = n.z;
    any_side[i] = normal ? 0.0f : 1.0f;
    const Rgb power = estimated_power(vertex);
    red[i] = power.x;
    green[i] = power.y;
    blue[i] = power.z;
    area[i] = nearby_area(light, count);
    s[i] = static_cast<std::int32_t>(light.size());
}

Rgb estimated_power(const PathVertex& vertex)
{
    constexpr float least_albedo = 0.04f;  // of usual dielectrics
    return vertex.beta * max(vertex.bsdf->base_color(), Rgb(least_albedo));
}

float nearby_area(std::span<const PathVertex> subpath, double count)
{
    constexpr float least_pdf = 1e-36f;  // [1/m^2]; below it the area would be infinite
    if (!joinable(subpath[subpath.size() - 2])) {
        return 0.0f;
    }
    const float pdf = std::max(subpath.back().pdf_fwd.value, least_pdf);
    return inv_pi / (static_cast<float>(count) * pdf);
}

namespace {

void prefetch_bytes(const void* begin, const void* end)
{
    constexpr std::ptrdiff_t line = 64;  // cache line size of most processors [bytes]
    const auto* last = static_cast<const std::byte*>(end);
    for (const auto* at = static_cast<const std::byte*>(begin); at < last; at += line) {
        __builtin_prefetch(at);
    }
    if (begin != end) {
        __builtin_prefetch(last - 1);
    }
}

}  // namespace

LightPathCache::LightPathCache(const LightPathCounts& counts, const RenderOptions& options)
    : counts_(counts),
      groups_(std::int64_t{options.film.width} * options.film.height, counts.bundles),
      kind_(options.sampling.sampler),
      seed_(options.sampling.seed),
      group_seed_(static_cast<std::uint32_t>(split_mix(seed_ + golden_ratio_64)))
{
    if (counts.kept()) {
        // A batch may begin and end within chunks.
        const std::int64_t bundles = (counts.bundles + counts.batches - 1) / counts.batches;
        const std::int64_t size =
            std::min(chunks(), (bundles + chunk_bundles - 1) / chunk_bundles + 1);
        chunks_.reserve(static_cast<std::size_t>(size));
        for (std::int64_t chunk = 0; chunk < size; ++chunk) {
            chunks_.emplace_back(*pool_);
        }
    }
}

ChunkRange LightPathCache::begin_batch(std::int64_t batch)
{
    const auto first_after = [this](std::int64_t batches) {
        const std::int64_t bundle = counts_.bundles * batches / counts_.batches;
        return std::min(chunks(), bundle / chunk_bundles + 1);
    };
    const std::int64_t end = first_after(batch + 1);
    if (batch == 0) {
        first_ = 0;
        return {.begin = 0, .end = end};
    }
    const std::int64_t begin = first_after(batch);
    std::swap(chunks_.front(), chunk_at(begin - 1));
    first_ = begin - 1;
    return {.begin = begin, .end = end};
}

int LightPathCache::usual_vertices(const RenderOptions& options)
{
    constexpr int under_roulette = 5;
    const int longest = StrategySet(options).light_vertices();
    const TransportOptions& transport = options.transport;
    const bool has_roulette = transport.rr_survival == 0.0f && transport.rr_start < longest;
    return has_roulette ? std::min(longest, transport.rr_start + under_roulette) : longest;
}

std::uint64_t LightPathCache::bytes(const LightPathCounts& counts, double mean_vertices)
{
    if (!counts.kept()) {
        return 0;
    }
    // In floating point, where the largest values of options do not overflow.
    const std::size_t vertex =
        sizeof(PathVertex) + sizeof(Bsdf) +
        (counts.rays > 0.0 ? sizeof(LightVertexBlock) / LightVertexBlock::size : 0) +
        (counts.merged ? LightVertexGrid::bytes_of_vertex : 0);
    const double bytes = static_cast<double>(counts.bundles / counts.batches) * counts.bundle *
                         mean_vertices * static_cast<double>(vertex);
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    return bytes < 0x1p63 ? static_cast<std::uint64_t>(bytes) : most;
}

Sampler LightPathCache::sampler(std::int64_t index, std::int64_t bundle, int which) const
{
    // Uses the random numbers of a pixel outside of every image.
    return {kind_, seed_, -1, static_cast<int>(bundle),
            subsample_index(index, counts_.bundle, which)};
}

void LightPathCache::begin_chunk(std::int64_t chunk)
{
    Chunk& filled = chunk_at(chunk);
    filled.moments.clear();
    filled.path_ends.clear();
    filled.vertices.clear();
    filled.bsdfs.clear();
    filled.blocks.clear();
    filled.bundle_begins.clear();
}

void LightPathCache::add_bundle(std::int64_t chunk, const TimeAndWavelength& moment)
{
    Chunk& filled = chunk_at(chunk);
    filled.moments.push_back(moment);
    if (counts_.rays > 0.0) {
        filled.bundle_begins.push_back(filled.blocks.size());
        filled.in_last_block = LightVertexBlock::size;
    }
}

void LightPathCache::add_path(std::int64_t chunk, std::span<const PathVertex> path)
{
    Chunk& filled = chunk_at(chunk);
    if (counts_.rays > 0.0) {
        add_to_blocks(filled, path);
    }
    for (const PathVertex& vertex : path) {
        filled.vertices.push_back(vertex);
        if (vertex.bsdf != nullptr && vertex.connectible) {
            filled.bsdfs.push_back(*vertex.bsdf);
        } else {
            filled.vertices.back().bsdf = nullptr;
        }
    }
    filled.path_ends.push_back({.vertices = filled.vertices.size(), .bsdfs = filled.bsdfs.size()});
}

void LightPathCache::add_to_blocks(Chunk& chunk, std::span<const PathVertex> path)
{
    const std::size_t path_in_bundle =
        chunk.path_ends.size() -
        (chunk.moments.size() - 1) * static_cast<std::size_t>(counts_.bundle);
    for (std::size_t s = 2; s <= path.size(); ++s) {
        if (!can_choose(path[s - 1])) {
            continue;
        }
        if (chunk.in_last_block == LightVertexBlock::size) {
            chunk.blocks.emplace_back();
            chunk.in_last_block = 0;
        }
        LightVertexBlock& block = chunk.blocks.back();
        const std::size_t i = chunk.in_last_block++;
        block.set(i, path.first(s), counts_.connections);
        block.path_begin[i] = static_cast<std::uint32_t>(chunk.vertices.size());
        block.path[i] = static_cast<std::uint32_t>(path_in_bundle);
    }
}

void LightPathCache::end_chunk(std::int64_t chunk)
{
    Chunk& filled = chunk_at(chunk);
    const Bsdf* next = filled.bsdfs.data();
    for (PathVertex& vertex : filled.vertices) {
        if (vertex.bsdf != nullptr) {
            vertex.bsdf = next++;
        }
    }
}

LightPathCache::Choice LightPathCache::choose(int x, int y, const ScheduledSample& sample) const
{
    const std::uint32_t u = groups_.place(x, y, group_seed_, sample.sub_index);
    const std::uint64_t place = std::uint64_t{u} * static_cast<std::uint64_t>(counts_.bundles);
    Choice choice{.bundle = static_cast<std::int64_t>(place >> 32U)};
    // The remaining fraction is uniform over the pixels of one bundle; from one sample to the next
    // of the same half of the film the sum of all counts grows by `connections`, and that of both
    // halves by twice as much, as they are offset by half of one.
    const double rest = static_cast<double>(static_cast<std::uint32_t>(place)) * 0x1p-32;
    const std::int64_t of_half = sample.index / 2;
    const double before = counts_.connections * static_cast<double>(of_half) + rest +
                          (sample.index % 2 == 0 ? 0.0 : 0.5);
    choice.count = static_cast<int>(std::floor(before + counts_.connections) - std::floor(before));
    if (choice.count < counts_.bundle) {
        choice.first = static_cast<int>(of_half % counts_.bundle);
    }
    return choice;
}

std::span<const PathVertex> LightPathCache::path(const Choice& choice, int which) const
{
    const Chunk& chunk = find_chunk(choice.bundle);
    const std::size_t path = find_path(choice, which);
    const std::size_t begin = chunk.path_begin(path).vertices;
    return std::span(chunk.vertices).subspan(begin, chunk.path_ends[path].vertices - begin);
}

std::span<const LightVertexBlock> LightPathCache::blocks(const Choice& choice) const
{
    const Chunk& chunk = find_chunk(choice.bundle);
    const std::size_t bundle = index_in_chunk(choice.bundle);
    const std::size_t begin = chunk.bundle_begins[bundle];
    const std::size_t end = bundle + 1 < chunk.bundle_begins.size()
                                ? chunk.bundle_begins[bundle + 1]
                                : chunk.blocks.size();
    return std::span(chunk.blocks).subspan(begin, end - begin);
}

void LightPathCache::prefetch_vertex(const PathVertex& vertex)
{
    // The vertex before it, too, is needed for weights; its BSDF lies elsewhere.
    prefetch_bytes(&vertex - 1, &vertex + 1);
}

void LightPathCache::prefetch(const Choice& choice) const
{
    const Chunk& chunk = find_chunk(choice.bundle);
    if (counts_.rays > 0.0) {
        const auto candidates = blocks(choice);
        prefetch_bytes(candidates.data(), candidates.data() + candidates.size());
        return;
    }
    for (int i = 0; i < choice.count; ++i) {
        const std::size_t path = find_path(choice, i);
        const PathEnd begin = chunk.path_begin(path);
        const PathEnd& end = chunk.path_ends[path];
        prefetch_bytes(chunk.vertices.data() + begin.vertices,
                       chunk.vertices.data() + end.vertices);
        prefetch_bytes(chunk.bsdfs.data() + begin.bsdfs, chunk.bsdfs.data() + end.bsdfs);
    }
}

}  // namespace bdpt
