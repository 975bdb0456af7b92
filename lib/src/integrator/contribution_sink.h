#pragma once

#include "film/pixel_filter.h"
#include "integrator/integrator.h"
#include "integrator/sample_schedule.h"
#include "path/connect.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Where a thread's integrator delivers every contribution that it finds: film, images of
/// strategies and observers get it from here alone.
class ContributionSink {
public:
    /// `weigher` tells observers the shares of strategies; null if the integrator has none. At most
    /// `max_splats` come in one sample. All must outlive this.
    ContributionSink(const Films& films, const PixelFilter& filter, PathWeigher* weigher,
                     std::size_t max_splats);

    /// Contributions until `end_sample` belong to this sample of pixel (x, y).
    void begin_sample(int x, int y, const ScheduledSample& sample);
    /// Contributions until `end_sample` are splats of a light path of that round, which belongs to
    /// no pixel.
    void begin_light_path(std::int64_t round) { begin_sample(-1, -1, {.index = round}); }
    /// Splats and contributions that come from here on belong to that light path of the sample.
    void begin_joins(int light_path)
    {
        light_path_ = light_path;
        merged_ = false;
    }
    /// Contributions that come from here on, until joins begin, were found by merging.
    void begin_merges() { merged_ = true; }
    /// Does anyone want that pixel?
    [[nodiscard]] bool holds_pixel() const { return holds(x_, y_); }
    /// A contribution to that pixel; the strategy takes `count` samples for each camera path.
    void add(const SampleContext& sample, Strategy strategy, const Contribution& found,
             float count);
    /// A contribution to the pixel at `found.raster`, or to one near it by the pixel filter;
    /// `dimension` tells the splats of one light path apart.
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
    /// To images of strategies and to observers, scaled.
    void report(Strategy strategy, Vec2 raster, Rgb weighted, Rgb unweighted, float weight);

    Films films_;
    const PixelFilter& filter_;
    PathWeigher* weigher_;
    std::vector<PendingSplat> splats_;  ///< wait for their pixels to come from memory
    int x_ = 0;
    int y_ = 0;
    std::int64_t index_ = 0;
    SampleScale scale_{};
    int light_path_ = 0;
    bool merged_ = false;
    Vec2 center_{0.0f};  ///< of the pixel
    Rgb radiance_{0.0f};
};

}  // namespace bdpt
