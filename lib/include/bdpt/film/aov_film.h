#pragma once

#include <bdpt/aov.h>
#include <bdpt/export.h>
#include <bdpt/film/exact_sum.h>
#include <bdpt/film/film.h>
#include <bdpt/image.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bdpt {

/// The first surface that a camera ray meets.
struct PrimaryHit {
    Rgb albedo{0.0f};
    Vec3 normal{0.0f};    ///< unit
    Vec3 position{0.0f};  ///< [m]
    float depth = 0.0f;   ///< along the camera's axis [m]
};

/// Direct light on the ground where a camera ray meets it: the luminance of its irradiance [lx].
struct GroundLight {
    float unshadowed = 0.0f;  ///< were the scene not in the way
    float shadowed = 0.0f;    ///< at most that
};

/// Do all pixels take equally many samples?
enum class PixelCounts : std::uint8_t {
    equal,  ///< as many as `Film::sample_count`
    own,    ///< sampleCount has those that `AovFilm::count_samples` was told
};

/// Sums of what camera rays met; exact and without order like those of `Film`.
class BDPT_EXPORT AovFilm {
public:
    AovFilm() = default;
    AovFilm(const PixelRect& region, AovSet aovs, PixelCounts counts = PixelCounts::equal);

    [[nodiscard]] const PixelRect& region() const { return region_; }
    [[nodiscard]] AovSet aovs() const { return aovs_; }
    [[nodiscard]] PixelCounts counts() const { return pixel_counts_; }
    /// Is there anything to add?
    [[nodiscard]] bool needs_camera_rays() const
    {
        return !hits_.empty() || needs_ground() || needs_opacity();
    }
    [[nodiscard]] bool needs_opacity() const { return !opacity_.empty(); }
    [[nodiscard]] bool needs_ground() const { return !ground_hits_.empty(); }
    [[nodiscard]] bool needs_counts() const { return !counts_.empty(); }

    /// Adds a ray of pixel (x, y) in the region. Safe from any thread, one thread a pixel.
    void add(int x, int y, const PrimaryHit& hit) noexcept;
    /// The same of a ray that meets the ground, where that is needed.
    void add_ground(int x, int y, const GroundLight& light) noexcept;
    /// The same of any ray, where that is needed: what surfaces take away of the light, in [0, 1].
    void add_opacity(int x, int y, float opacity) noexcept;
    /// States that `count` samples of pixel (x, y) in the region are in the image; likewise.
    void count_samples(int x, int y, std::int64_t count) noexcept;

    /// Adds the rays of other samples. Throws `Error` (usage) when regions or AOVs differ.
    void merge(const AovFilm& other);
    /// The layers that were asked for, by the names that denoisers and compositors expect: albedo
    /// (RGB), normal (XYZ), depth (Z), position (XYZ), sampleCount (Y), variance (RGB), shadow (A),
    /// opacity (A), and A in the main layer. `film` is that of the same samples; throws `Error`
    /// (usage) when its region is another.
    [[nodiscard]] std::vector<Layer> develop(const Film& film) const;

    // For files, as those of `Film`: "albedo.R", ..., "hits" and "counts" of every pixel.
    [[nodiscard]] std::vector<std::string> plane_names() const;
    void read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const;
    void add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words);

    /// Equal to the bit.
    [[nodiscard]] bool operator==(const AovFilm& other) const = default;

private:
    using Sum3 = std::array<ExactSum, 3>;

    /// A sum of each pixel, or a count.
    struct Plane {
        std::string name;
        std::vector<Sum3> AovFilm::*color = nullptr;
        std::size_t channel = 0;
        std::vector<ExactSum> AovFilm::*single = nullptr;
        std::vector<std::uint64_t> AovFilm::*count = nullptr;
    };
    [[nodiscard]] std::vector<Plane> planes() const;
    /// The index of a pixel in the region.
    [[nodiscard]] std::size_t index(int x, int y) const;
    /// The opacity of the shadow in a pixel of that many samples.
    [[nodiscard]] double shadow_opacity(std::size_t pixel, double samples) const;

    PixelRect region_;
    AovSet aovs_;
    PixelCounts pixel_counts_ = PixelCounts::equal;
    // One element a pixel if it is asked for, else empty.
    std::vector<Sum3> albedo_;
    std::vector<Sum3> normal_;
    std::vector<Sum3> position_;
    std::vector<ExactSum> depth_;
    std::vector<std::uint64_t> hits_;
    std::vector<std::uint64_t> counts_;
    std::vector<ExactSum> opacity_;
    std::vector<ExactSum> unshadowed_;
    std::vector<ExactSum> shadowed_;
    std::vector<std::uint64_t> ground_hits_;
};

}  // namespace bdpt
