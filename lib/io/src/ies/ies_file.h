#pragma once

#include "file/bytes.h"
#include "file/warnings.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt::io {

/// How the angles of a measurement lie in space [LM-63-02, "photometric type"].
enum class Photometry : std::uint8_t {
    c = 1,  ///< vertical angles from the nadir, horizontal ones around it: most luminaires
    b = 2,  ///< planes with a common horizontal axis: floodlights
    a = 3,  ///< planes with a common vertical axis: headlights
};

/// What light needs to know of an IES file.
struct IesFile {
    Photometry photometry = Photometry::c;
    std::vector<double> vertical_angles;    ///< [degrees] two or more, ascending
    std::vector<double> horizontal_angles;  ///< [degrees] one or more, ascending
    /// [cd] Those of all vertical angles for each horizontal one, with all factors; >= 0.
    std::vector<float> candelas;
};

/// The greatest file that is read [bytes], and the most intensities of one.
inline constexpr std::uint64_t max_ies_bytes = std::uint64_t{32} << 20;
inline constexpr long max_ies_values = 1'000'000;

/// Reads a light profile of LM-63-95, LM-63-02 or LM-63-19; older ones pass for LM-63-95. Keywords,
/// TILT, lamps, measures and watts do not count. `place` is where warnings come from. Throws
/// `Error` (invalid_input) that names line, item and value.
[[nodiscard]] IesFile read_ies(ByteView bytes, const std::string& place, Warnings& warnings);

}  // namespace bdpt::io
