#pragma once

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "file/messages.h"
#include "file/read_file.h"

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

/// Reader of the numbers in a text, separated by blanks, commas and ends of lines [LM-63-02,
/// "delimiter"].
class IesNumbers {
public:
    /// `first_line`: number of the text's first line in its file.
    IesNumbers(std::string_view text, std::size_t first_line) : rest_(text), line_(first_line) {}

    /// Returns the next number, which is finite. Throws `Error` (invalid_input) that names the
    /// expected `what` if there is none.
    [[nodiscard]] double next(std::string_view what);
    /// Returns the next number, which must be an integer in [least, most].
    [[nodiscard]] long next_integer(std::string_view what, long least, long most);
    /// Tests whether nothing is left.
    [[nodiscard]] bool at_end();

    /// Throws `Error` (invalid_input) that names the line of the last number.
    [[noreturn]] void fail(const std::string& what) const;

private:
    void skip_delimiters();

    std::string_view rest_;
    std::size_t line_;
};

/// A light profile and the rotation of its axes in a luminaire that points down -z [EXT_lights_ies,
/// "Coordinate System Mapping"].
struct IesProfile {
    LightProfile profile;
    Mat3 node_from_profile{1.0f};  ///< rotation
};

/// Converts a file to a profile, completing it by its symmetry. Throws `Error` (invalid_input) for
/// angles that its photometry does not have.
[[nodiscard]] IesProfile make_profile(const IesFile& file, const std::string& place,
                                      Warnings& warnings);

}  // namespace bdpt::io
