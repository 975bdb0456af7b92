#pragma once

#include "file/bytes.h"
#include "file/warnings.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt::io {

/// Orientation of the angles of a measurement [LM-63-02, "photometric type"].
enum class Photometry : std::uint8_t {
    c = 1,  ///< vertical angles from the nadir, horizontal ones around it: most luminaires
    b = 2,  ///< planes with a common horizontal axis: floodlights
    a = 3,  ///< planes with a common vertical axis: headlights
};

/// The contents of an IES file that a light needs.
struct IesFile {
    Photometry photometry = Photometry::c;
    std::vector<double> vertical_angles;    ///< [degrees], two or more, ascending
    std::vector<double> horizontal_angles;  ///< [degrees], one or more, ascending
    /// Intensities [cd] at all vertical angles for each horizontal one, with all factors applied;
    /// >= 0.
    std::vector<float> candelas;
};

/// Maximum size of a file [bytes], and maximum number of its intensities.
inline constexpr std::uint64_t max_ies_bytes = std::uint64_t{32} << 20;
inline constexpr long max_ies_values = 1'000'000;

/// Reads a light profile of LM-63-95, LM-63-02 or LM-63-19; older ones are read as LM-63-95.
/// Keywords, TILT, lamps, measures and watts are ignored. `place` is the source of warnings. Throws
/// `Error` (invalid_input) that names line, item and value.
[[nodiscard]] IesFile read_ies(ByteView bytes, const std::string& place, Warnings& warnings);

}  // namespace bdpt::io
