#pragma once

#include "film/pixel_filter.h"
#include "integrator/integrator.h"
#include "integrator/sample_schedule.h"
#include "path/connect.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Receives every contribution that a thread's integrator finds: the only source of film, strategy
/// images and observers.
class ContributionSink {
public:
    /// `weigher` provides the shares of strategies for observers; null if the integrator has none.
    /// At most `max_splats` are added per sample. All arguments must outlive this.
    ContributionSink(const Films& films, const PixelFilter& filter, PathWeigher* weigher,
                     std::size_t max_splats);

    /// Starts a sample of pixel (x, y), to which contributions until `end_sample` belong.
    void begin_sample(int x, int y, const ScheduledSample& sample);
    /// Starts a light path of that round, which belongs to no pixel; contributions until
    /// `end_sample` are its splats.
    void begin_light_path(std::int64_t round) { begin_sample(-1, -1, {.index = round}); }
    /// Attributes subsequent splats and contributions to that light path of the sample.
    void begin_joins(int light_path)
    {
        light_path_ = light_path;
        merged_ = false;
    }
    /// Marks subsequent contributions as merged, until `begin_joins`.
    void begin_merges() { merged_ = true; }
    [[nodiscard]] int x() const { return x_; }
    [[nodiscard]] int y() const { return y_; }
    /// Tests whether the film or an observer needs that pixel.
    [[nodiscard]] bool holds_pixel() const { return holds(x_, y_); }
    /// Adds a contribution to that pixel; the strategy takes `count` samples per camera path.
    void add(const SampleContext& sample, Strategy strategy, const Contribution& found,
             float count);
    /// Adds a contribution to the pixel at `found.raster`, or to a nearby one by the pixel filter;
    /// `dimension` distinguishes the splats of one light path.
    void splat(SampleContext& sample, Strategy strategy, const Contribution& found, float count,
               std::uint32_t dimension);
    /// Adds the sample to the film.
    void end_sample();

private:
    struct PendingSplat {
        Vec2 raster;
        Rgb radiance;
    };
    [[nodiscard]] bool holds(int x, int y) const
    {
        return films_.film == nullptr || films_.film->region().contains(x, y);
    }
    /// Passes a contribution, scaled, to strategy images and observers.
    void report(Strategy strategy, Vec2 raster, Rgb weighted, Rgb unweighted,
                const Contribution& found);

    Films films_;
    const PixelFilter& filter_;
    PathWeigher* weigher_;
    std::vector<PendingSplat> splats_;  ///< wait until their pixels are prefetched
    int x_ = 0;
    int y_ = 0;
    std::int64_t index_ = 0;
    SampleScale scale_{};
    int light_path_ = 0;
    bool merged_ = false;
    Vec2 center_{0.0f};  ///< centre of the pixel
    Rgb radiance_{0.0f};
};

}  // namespace bdpt
