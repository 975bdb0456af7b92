#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace bdpt {

/// The paths of the pilot that measures: enough to tell candidates apart, few beside a render.
struct PilotSampling {
    std::uint64_t seed = 0x70696c6f74;  ///< users will hardly choose it
    /// Cells for each pixel, and limits of their number. With one in 16, rare bright paths decided
    /// in small images.
    double cells_per_pixel = 1.0 / 8.0;
    double min_cells = 512.0;
    double max_cells = 8192.0;
    /// Number of planned camera samples for each cell, whose paths cost about as much as 12 of
    /// `mis` (6 to 18 in 12 scenes): some 7 % of the work. With fewer cells than `fewest_cells` a
    /// choice is chance.
    double samples_per_cell = 160.0;
    double fewest_cells = 256.0;
    /// Of each camera path: light paths that it is connected to, and rays that choose among these
    /// connections, so many that nearly all are made.
    int connections = 2;
    double connection_rays = 4096.0;
    /// Longer paths contribute little, and would cost more time and memory than they are worth.
    int max_path_length = 32;  ///< [edges]
    double merge_radius = 0.005;
    int max_merges = 32;  ///< usual scenes rarely have more
    /// Number of paths that are all kept of those that one camera path finds; of more, about as
    /// many. In 44 of 46 scenes errors change by less than 0.5 %.
    std::size_t kept_paths = 8;
    /// Camera paths that find this share of such paths, or more, tell the brightness of their
    /// pixel; else splats do.
    float often = 0.1f;
    /// Floor of squared brightness in relative errors, over the square of the image's mean; as
    /// `eval` measures errors.
    double epsilon = 0.01;
    /// Light is rare if more than this fraction of the lit cells has its brightness from fewer than
    /// `fewest_paths` paths. In the 30 scenes at most 0.04 has, in six rooms with doors 0.85.
    double rare_fraction = 0.25;
    /// Square of the brightness over its variance: N paths of equal light, found by chance, have N.
    double fewest_paths = 1.5;
};

/// Fractions of the variance of independent samples that Sobol points leave, as fitted to renders
/// of 32 samples in the 30 scenes by `qmc_variance_factor.cpp`. Splats do not benefit, nor do paths
/// in bodies that scatter light: their integrands have too many dimensions and peaks.
struct QmcVarianceFactors {
    double direct = 0.25;
    /// Of indirect light that a camera path finds alone: the least, and the number of samples that
    /// find one such path from which half of the benefit is lost. A single sample is not
    /// stratified.
    double indirect = 0.3;
    double rare = 4.0;
    double connections = 0.3;
    double choice = 0.2;  ///< of what the choice of connections adds
    double in_body = 1.0;
    /// Of products of different paths of a sample: direct, indirect, in bodies.
    std::array<double, 3> sums{0.25, 0.4, 1.0};
};

/// Errors that a pilot of few paths cannot measure.
struct RarePathConstants {
    double usual_samples = 64.0;  ///< of a usual render, per pixel
    /// The error excludes the brightest paths of a usual render, up to these limits: their number
    /// over that of the pixels, and their light over that of the image. With one in 1000 pixels,
    /// `orthographic` had 3.5 times the error.
    double max_fireflies = 0.0003;
    double max_light_of_fireflies = 0.0025;
    /// Their error counts as far as it exceeds this many standard errors: more than one, so that a
    /// single path is no evidence.
    double margin_of_fireflies = 1.25;
    /// Errors of unseen paths: standard errors, at most a fraction of the error, both of one light
    /// path per camera path. A fifth everywhere had 1.45 times error times time in furnace.
    double unseen_standard_errors = 2.0;
    double max_unseen = 0.2;
};

/// Costs [ns], fitted to the CPU time of 48 scenes x 8 candidates, up to one factor per scene (root
/// mean square residual: 5 %), `light_paths_of_sample` to images of background. Only their ratios
/// matter.
struct CostModel {
    struct Path {
        double sample;
        double segment;  ///< segment of a walk
        double shadow;   ///< shadow ray of a connection, with its BSDFs and weights
    };
    Path path_tracing{.sample = 20.0, .segment = 305.0, .shadow = 285.0};
    Path camera_path{.sample = 60.0, .segment = 345.0, .shadow = 310.0};
    Path light_path{.sample = 20.0, .segment = 400.0, .shadow = 205.0};
    double light_paths_of_sample = 80.0;  ///< to find those that it connects to
    double connection = 200.0;            ///< its shadow ray
    /// Likewise, of a vertex that is not yet in the cache.
    double chosen_connection = 245.0;
    double estimate = 3.0;             ///< to choose connections, for each pair of vertices
    double shared_light_path = 150.0;  ///< to store it in memory
    double shared_choice = 30.0;       ///< to fetch it from there
    /// Factor for the segment of a camera path that leaves the scene at once: such rays meet few
    /// boxes of the BVH, and no BSDF follows. Fitted to 29 scenes x 10 candidates; what else
    /// bidirectional samples cost weighs more then.
    double background_segment = 0.3;
    /// Factor for all of a sample in a cell of background, by which rates judge.
    double background_cell = 0.5;
};

/// How `choose` compares candidates.
struct ChoiceConstants {
    /// Least error that is distinguishable from zero [relMSE]. Smaller ones are noise of the pilot,
    /// and images without error are best where they cost least.
    double min_error = 1e-4;
    /// What connections gain is often more than predicted: light paths without them have to be
    /// better by this factor. Without it, 6 to 29 % were lost where they were nearly chosen.
    double margin_of_connections = 1.05;
    /// Standard errors of the difference by which a gain is sure. With those of the candidate
    /// itself, HotelRoom under courtyard.exr had 1.33 times the error at equal time; with two of
    /// them, a single bright path hid there a gain of a third.
    double sure_standard_errors = 1.5;
};

/// Rates of samples by cells (docs/decisions/0051-adaptive-sampling.md).
struct RateConstants {
    /// Few samples in a pixel make rare bright paths brighter still, and what two samples in each
    /// cell say is too uncertain for larger rates: up to 4, HotelRoom lost 9 %.
    int min_exponent = -1;
    int max_exponent = 1;
    /// Errors of cells are averaged over 7 x 7, as each has two samples.
    int mean_radius = 3;
    /// Rates change within about this distance: chance makes islands, whose borders would be seen.
    double smooth_pixels = 8.0;
    /// Islands of about half of 11 x 11 cells, and smaller ones, are taken for chance: one bright
    /// path affects 7 x 7.
    int island_radius = 5;
    /// Error beside the pilot's estimate and fireflies, as a fraction of the mean error: rare
    /// bright paths also occur where the pilot has not found them.
    double unseen_share = 0.25;
    /// Cells where no camera path scatters have this share of both, relative to other cells: light
    /// that is seen directly has little noise, which the pilot does not measure.
    double share_of_background = 0.05;
    /// Fraction of the cells with the greatest errors, all of which count like the least of them.
    double share_of_fireflies = 0.001;
    /// Rates are worth it if they reduce error times cost to this or less: in rooms Sobol points
    /// lose more than rates gain.
    double worthwhile = 0.94;
};

/// The pilot that learns light.
struct LightPilotConstants {
    std::uint64_t seed = 0x7669736962;  ///< users will hardly choose it
    /// Camera paths along each side of the image: one per pixel, up to a number beyond which more
    /// have no benefit.
    int min_side = 16;
    int max_side = 128;
    /// Number of planned camera samples for each path, which costs about as much as one of `mis`
    /// (0.5 to 1.8 in 12 scenes): some 3 % of the work. None are traced if that is less than
    /// `min_side` squared.
    double samples_per_path = 40.0;
    /// Later vertices lie where earlier ones do, and carry less light.
    int edges = 8;
    /// If a larger fraction of rays reaches the environment, tiles without learned visibility do as
    /// well and take less time: a shader ball gains at 0.76, a car in a studio does not at 0.80.
    double max_visible = 0.78;
    /// If a smaller fraction does, everything is hidden equally and there is nothing to learn.
    double min_visible = 1e-3;
    /// Lights on one mesh are several lamps if there are more triangles than a box has, over more
    /// than this part of the scene.
    std::size_t max_triangles_of_a_lamp = 12;
    float max_extent_of_a_lamp = 0.25f;
    std::size_t max_suns = 4;  ///< more are not worth a ray each
    /// Parts of a starting probability that the pilot does not determine, so that light paths also
    /// start at lights whose light it missed: in proportion to power, and equal for all groups.
    double power_part = 0.1;
    double even_part = 0.1;
    /// Each light of a group counts as found so many more times, with values in proportion to
    /// power: there may be more lights than the pilot has paths.
    double prior_findings = 16.0;
};

/// Everything that the pilots assume, with what it was fitted to
/// (docs/decisions/0044-pilot.md, 0051, 0068, 0075).
struct PilotConstants {
    PilotSampling sampling;
    QmcVarianceFactors qmc;
    RarePathConstants rare;
    CostModel cost;
    ChoiceConstants choice;
    RateConstants rates;
    LightPilotConstants light;
};

inline constexpr PilotConstants pilot_constants{};

}  // namespace bdpt
