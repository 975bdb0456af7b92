#include "part/part_contents.h"

#include <array>
#include <bit>
#include <cstdint>

namespace bdpt::io {
namespace {

constexpr int words_of_sum = 4;  // 32-bit words
static_assert(sizeof(ExactSum::Words) == words_of_sum * sizeof(std::uint32_t));

constexpr std::array<const char*, id_kinds.size()> prefixes{"object.", "material.", "instance."};

/// Returns "object.0", ..., a plane for each rank of each kind.
std::vector<std::string> id_planes(const IdRanks& ranks)
{
    std::vector<std::string> names;
    for (const IdKind kind : id_kinds) {
        for (std::size_t rank = 0; rank < ranks[static_cast<std::size_t>(kind)]; ++rank) {
            names.push_back(std::string(prefixes[static_cast<std::size_t>(kind)]) +
                            std::to_string(rank));
        }
    }
    return names;
}

/// Returns the position in memory of the 32 bits of that rank, 0 being the lowest.
std::size_t compute_offset(int rank)
{
    constexpr bool little = std::endian::native == std::endian::little;
    return sizeof(std::uint32_t) * static_cast<std::size_t>(little ? rank : rank ^ 1);
}

}  // namespace

PlaneRow::PlaneRow(const RenderResult& part, const IdRanks& ranks)
    : left_(part.film.region().x0),
      width_(static_cast<std::size_t>(part.film.width())),
      film_(Film::plane_names()),
      aovs_(part.aovs.plane_names()),
      strategies_(part.strategies.plane_names()),
      ids_(id_planes(ranks)),
      ranks_(ranks),
      words_((film_.size() + aovs_.size() + strategies_.size() + ids_.size()) * width_)
{}

std::vector<std::string> PlaneRow::channels() const
{
    std::vector<std::string> result;
    for (const auto* planes : {&film_, &aovs_, &strategies_, &ids_}) {
        for (const std::string& plane : *planes) {
            for (int rank = 0; rank < words_of_sum; ++rank) {
                result.push_back(plane + "." + std::to_string(rank));
            }
        }
    }
    return result;
}

Imf::FrameBuffer PlaneRow::frame_buffer()
{
    Imf::FrameBuffer buffer;
    constexpr std::size_t stride = sizeof(ExactSum::Words);
    std::size_t i = 0;
    for (const std::string& channel : channels()) {
        auto* const first = reinterpret_cast<char*>(plane_sums(i / words_of_sum).data());
        char* const base = first + compute_offset(static_cast<int>(i % words_of_sum)) -
                           static_cast<std::ptrdiff_t>(stride) * left_;
        buffer.insert(channel, Imf::Slice(Imf::UINT, base, stride, 0));  // all rows in one place
        ++i;
    }
    return buffer;
}

std::span<ExactSum::Words> PlaneRow::plane_sums(std::size_t plane)
{
    return {words_.data() + plane * width_, width_};
}

std::span<const ExactSum::Words> PlaneRow::plane_sums(std::size_t plane) const
{
    return {words_.data() + plane * width_, width_};
}

void PlaneRow::take(const RenderResult& part, int row)
{
    std::size_t plane = 0;
    const auto take_planes = [&](const auto& film, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            film.read_row(i, row, plane_sums(plane++));
        }
    };
    take_planes(part.film, film_.size());
    take_planes(part.aovs, aovs_.size());
    take_planes(part.strategies, strategies_.size());
    for (const IdKind kind : id_kinds) {
        for (std::size_t rank = 0; rank < ranks_[static_cast<std::size_t>(kind)]; ++rank) {
            part.ids.read_row(kind, rank, row, plane_sums(plane++));
        }
    }
}

void PlaneRow::add_to(RenderResult& part, int row, std::int64_t samples) const
{
    std::size_t plane = 0;
    const auto add_planes = [&](auto& film, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            film.add_row(i, row, plane_sums(plane++));
        }
    };
    add_planes(part.film, film_.size());
    add_planes(part.aovs, aovs_.size());
    add_planes(part.strategies, strategies_.size());
    for (const IdKind kind : id_kinds) {
        const std::size_t count = ranks_[static_cast<std::size_t>(kind)];
        part.ids.add_row(kind, row, {words_.data() + plane * width_, count * width_}, samples);
        plane += count;
    }
}

}  // namespace bdpt::io
