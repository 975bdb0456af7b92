#pragma once

/// @file
/// Sums up what camera rays meet, for the layers of AOVs.
///
/// @code{.cpp}
/// void print_depth(const bdpt::RenderResult& result)  // rendered with Aov::depth
/// {
///     for (const bdpt::Layer& layer : result.aovs.develop(result.film)) {
///         if (layer.name == "depth") {
///             std::cout << layer.values[0] << " m at the top left\n";
///         }
///     }
/// }
/// @endcode

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

/// The first surface that a camera ray hits: the value of each AOV of first surfaces. Layers of one
/// channel have it in x.
class PrimaryHit {
public:
    [[nodiscard]] Vec3& operator[](Aov aov) { return values_[static_cast<std::size_t>(aov)]; }
    [[nodiscard]] const Vec3& operator[](Aov aov) const
    {
        return values_[static_cast<std::size_t>(aov)];
    }

private:
    std::array<Vec3, aov_layers.size()> values_{};
};

/// Direct light on the ground where a camera ray hits it: luminance of its irradiance [lx].
struct GroundLight {
    float unshadowed = 0.0f;  ///< without the scene in the way
    float shadowed = 0.0f;    ///< at most `unshadowed`; an estimate may be negative
};

/// The source of the sample counts of pixels.
enum class PixelCounts : std::uint8_t {
    equal,  ///< every pixel has `Film::sample_count` samples
    own,    ///< sampleCount stores the counts passed to `AovFilm::count_samples`
};

/// Sums of the AOVs of camera rays; exact and independent of order, like those of `Film`.
class BDPT_EXPORT AovFilm {
public:
    AovFilm() = default;
    AovFilm(const PixelRect& region, AovSet aovs, PixelCounts counts = PixelCounts::equal);

    [[nodiscard]] const PixelRect& region() const { return region_; }
    [[nodiscard]] AovSet aovs() const { return aovs_; }
    [[nodiscard]] PixelCounts counts() const { return pixel_counts_; }
    /// Tests whether there is anything to add.
    [[nodiscard]] bool needs_camera_rays() const
    {
        return !hits_.empty() || needs_ground() || needs_opacity();
    }
    [[nodiscard]] bool needs_opacity() const { return !opacity_.empty(); }
    [[nodiscard]] bool needs_ground() const { return !ground_hits_.empty(); }
    [[nodiscard]] bool needs_counts() const { return !counts_.empty(); }

    /// Adds a ray of pixel (x, y) in the region. Safe from any thread, as long as one thread at a
    /// time adds to a pixel.
    void add(int x, int y, const PrimaryHit& hit) noexcept;
    /// Adds a ray that hits the ground, if `needs_ground()`.
    void add_ground(int x, int y, const GroundLight& light) noexcept;
    /// Adds `rays` that hit the ground where nothing blocks its light of `irradiance` [lx], if
    /// `needs_ground()`.
    void add_open_ground(int x, int y, float irradiance, std::int64_t rays) noexcept;
    /// Adds the opacity of any ray, if `needs_opacity()`: the fraction of light that surfaces
    /// block, in [0, 1].
    void add_opacity(int x, int y, float opacity) noexcept;
    /// Records that `count` samples of pixel (x, y) in the region are in the image; threads as for
    /// `add`.
    void count_samples(int x, int y, std::int64_t count) noexcept;

    /// Adds the rays of other samples. Throws `Error` (usage) if regions or AOVs differ.
    void merge(const AovFilm& other);
    /// Returns the requested layers, with the names that denoisers and compositors expect: albedo
    /// (RGB), normal and cameraNormal (XYZ), depth and distance (Z), position (XYZ), uv (UV),
    /// sampleCount (Y), variance (RGB), shadow (A), opacity (A), and A in the main layer. `film`
    /// must hold the same samples; throws `Error` (usage) if its region differs.
    [[nodiscard]] std::vector<Layer> develop(const Film& film) const;

    // Access for files, as in `Film`: "albedo.R", ..., "hits" and "counts" of every pixel.
    [[nodiscard]] std::vector<std::string> plane_names() const;
    void read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const;
    void add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words);

    /// Returns the fraction of the camera rays of each pixel that met a surface, row by row; empty
    /// if `Aov::alpha` was not asked for. `film` must hold the same samples.
    [[nodiscard]] std::vector<float> coverage(const Film& film) const;

    /// Tests for bit equality.
    [[nodiscard]] bool operator==(const AovFilm& other) const = default;

private:
    /// A sum or a count for each pixel.
    struct Plane {
        std::string name;
        std::size_t layer = 0;    // of `surface_`
        std::size_t channel = 0;  // of that
        std::vector<ExactSum> AovFilm::*sums = nullptr;
        std::vector<std::uint64_t> AovFilm::*counts = nullptr;
    };
    [[nodiscard]] std::vector<Plane> planes() const;
    /// Returns the index of a pixel's sum in a plane of `surface_`.
    [[nodiscard]] static std::size_t element(const Plane& plane, std::size_t pixel);
    /// Returns the index of a pixel in the region.
    /// Returns the opacity of the shadow in a pixel with that many samples.
    [[nodiscard]] double shadow_opacity(std::size_t pixel, double samples) const;

    PixelRect region_;
    AovSet aovs_;
    PixelCounts pixel_counts_ = PixelCounts::equal;
    // One sum per pixel and channel for each row of `aov_layers` that was requested, else empty.
    std::array<std::vector<ExactSum>, aov_layers.size()> surface_;
    // One element per pixel if requested, else empty.
    std::vector<std::uint64_t> hits_;
    std::vector<std::uint64_t> counts_;
    std::vector<ExactSum> opacity_;
    std::vector<ExactSum> unshadowed_;
    std::vector<ExactSum> shadowed_;
    std::vector<std::uint64_t> ground_hits_;
};

}  // namespace bdpt
