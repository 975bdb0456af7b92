#pragma once

#include <bdpt/image.h>
#include <bdpt/inspect.h>
#include <bdpt/io/display.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace bdpt::job {

// `origin`: that of the world, in the coordinates of the file, which positions are told in.

/// Returns tables of the vertices and of the contributions of strategies, for people.
[[nodiscard]] std::string inspect_text(const InspectedSample& sample, const PixelSample& which,
                                       const DVec3& origin);

/// Returns the complete data of the sample, for programs.
[[nodiscard]] nlohmann::ordered_json inspect_json(const InspectedSample& sample,
                                                  const PixelSample& which, const DVec3& origin);

/// Draws six labelled spheres of directions: incident light and the BSDF, tone-mapped; the
/// zero-variance density (the product of the two over its integral), the densities of BSDF sampling
/// and of light sampling, and their mean with `light_samples` of the latter, as heat colours of one
/// scale of four decades.
[[nodiscard]] io::DisplayImage direction_sheet(const DirectionMaps& maps, int light_samples);

/// Returns the maps as layers of an EXR file beside the product: incident, scattering, bsdf_pdf,
/// light_pdf.
[[nodiscard]] std::vector<Layer> direction_layers(const DirectionMaps& maps);

/// Returns the integral of each channel over all directions.
[[nodiscard]] Rgb sphere_integral(const Image& map);

}  // namespace bdpt::job
