#include <bdpt/film/id_film.h>

#include <bdpt/error.h>

#include <algorithm>
#include <limits>

namespace bdpt {
namespace {

[[noreturn]] void fail(const char* what)
{
    throw Error(ErrorCode::invalid_input, what);
}

/// Reads the ids of a pixel from planes, one after the other.
class PixelReader {
public:
    /// `known` is sorted.
    PixelReader(std::span<const NameId> known, std::int64_t samples)
        : known_(known), left_(static_cast<std::uint64_t>(samples))
    {}

    void add(const ExactSum::Words& words, IdCounts& counts)
    {
        if (words.low == 0 && words.high == 0) {
            ended_ = true;
            return;
        }
        if (ended_ || words.high <= last_) {
            fail("has ids of a pixel that are not in ascending order");
        }
        const NameId id{static_cast<std::uint32_t>(words.high)};
        if (words.high > std::numeric_limits<std::uint32_t>::max() ||
            !std::binary_search(known_.begin(), known_.end(), id)) {
            fail("has an id without a name");
        }
        if (words.low == 0 || words.low > left_) {
            fail("has an id without hits, or with more than samples");
        }
        last_ = words.high;
        left_ -= words.low;
        counts.add(id, static_cast<std::uint32_t>(words.low));
    }

private:
    std::span<const NameId> known_;
    std::uint64_t left_;
    std::uint64_t last_ = 0;
    bool ended_ = false;
};

}  // namespace

IdRanks IdFilm::ranks() const
{
    IdRanks result{};
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        for (const IdCounts& counts : pixels_[kind]) {
            result[kind] = std::max(result[kind], counts.size());
        }
    }
    return result;
}

void IdFilm::read_row(IdKind kind, std::size_t rank, int row,
                      std::span<ExactSum::Words> words) const
{
    const std::vector<IdCounts>& pixels = pixels_[static_cast<std::size_t>(kind)];
    for (std::size_t x = 0; x < words.size(); ++x) {
        const IdCounts& counts = pixels[row_begin(row) + x];
        words[x] = rank < counts.size()
                       ? ExactSum::Words{.low = counts[rank].count,
                                         .high = static_cast<std::uint32_t>(counts[rank].id)}
                       : ExactSum::Words{};
    }
}

void IdFilm::add_row(IdKind kind, int row, std::span<const ExactSum::Words> planes,
                     std::int64_t samples)
{
    const auto which = static_cast<std::size_t>(kind);
    const auto width = static_cast<std::size_t>(region_.width());
    for (std::size_t x = 0; x < width; ++x) {
        PixelReader reader(known_[which], samples);
        for (std::size_t i = x; i < planes.size(); i += width) {
            reader.add(planes[i], pixels_[which][row_begin(row) + x]);
        }
    }
}

}  // namespace bdpt
