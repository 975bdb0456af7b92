#pragma once

#include <bdpt/aov.h>
#include <bdpt/export.h>
#include <bdpt/film/exact_sum.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_counts.h>
#include <bdpt/film/name_id.h>
#include <bdpt/image.h>
#include <bdpt/pixel_rect.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bdpt {

/// The kinds of things that have ids.
enum class IdKind : std::uint8_t { object, material };

/// All of them; what there is of each kind has this order.
inline constexpr std::array id_kinds{IdKind::object, IdKind::material};

/// The AOV of each kind.
inline constexpr std::array id_aovs{Aov::object, Aov::material};

/// The names that may be met, of each kind, in the order of their bytes, each once.
using IdNames = std::array<std::vector<NamedId>, id_kinds.size()>;

/// The greatest number of ids that a pixel has, of each kind.
using IdRanks = std::array<std::size_t, id_kinds.size()>;

/// The names behind the ids of layers.
struct IdManifest {
    std::string layer;  ///< "CryptoObject"; those layers add a number to it
    std::vector<NamedId> names;
};

/// Counts of the objects and materials that camera rays meet first: numbers without order, exact,
/// as many ids a pixel as there are.
class BDPT_EXPORT IdFilm {
public:
    IdFilm() = default;
    /// `aovs` say which kinds are counted.
    IdFilm(const PixelRect& region, AovSet aovs, IdNames names);

    /// How many ids of a pixel are in its layers: those that most rays met.
    static constexpr std::size_t levels = 6;

    [[nodiscard]] const PixelRect& region() const { return region_; }
    [[nodiscard]] const IdNames& names() const { return names_; }
    /// Is there anything to count?
    [[nodiscard]] bool needs_hits() const;

    /// Adds rays of pixel (x, y) in the region: what those met that met a surface; changes their
    /// order. Safe from any thread, one thread a pixel.
    void add(int x, int y, std::span<SurfaceIds> met);

    /// Adds the rays of other samples. Throws `Error` (usage) when regions or names differ.
    void merge(const IdFilm& other);

    /// Cryptomatte layers of what was asked for [Cryptomatte specification 1.2.0]: CryptoObject00
    /// to 02, CryptoMaterial00 to 02, each with two ids (r, b) and the shares of all samples that
    /// met them (g, a). The greatest share comes first; of equal ones the lesser id. `film` is that
    /// of the same samples; throws `Error` (usage) when its region is another.
    [[nodiscard]] std::vector<Layer> develop(const Film& film) const;
    /// The manifests of these layers. They include names that no ray has met.
    [[nodiscard]] std::vector<IdManifest> manifests() const;

    // For files: a plane for each rank of a kind, with the rank-th id (high) of every pixel, in the
    // order of ids, and its count (low); zeros where the pixel has fewer.
    [[nodiscard]] IdRanks ranks() const;
    void read_row(IdKind kind, std::size_t rank, int row, std::span<ExactSum::Words> words) const;
    /// `planes`: that row of one rank after the other; counts of a pixel add up to `samples` at
    /// most. Throws `Error` (invalid_input) for what no film has.
    void add_row(IdKind kind, int row, std::span<const ExactSum::Words> planes,
                 std::int64_t samples);

    /// Equal to the bit.
    [[nodiscard]] bool operator==(const IdFilm& other) const = default;

private:
    [[nodiscard]] std::size_t begin_of(int row) const;

    PixelRect region_;
    IdNames names_;
    std::array<std::vector<NameId>, id_kinds.size()> known_;     // those of the names, sorted
    std::array<std::vector<IdCounts>, id_kinds.size()> pixels_;  // empty: not asked for
};

}  // namespace bdpt
