#pragma once

#include <bdpt/part/render_result.h>

#include <OpenEXR/ImfFrameBuffer.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bdpt::io {

/// The sums of all films of a part, one row of all planes at a time, and the view of OpenEXR on
/// that row: each sum as four channels of 32 bits, "half0.R.0" (the lowest) to "half0.R.3".
class PlaneRow {
public:
    /// `part` has the films; `ranks`: ranks of ids that there are planes for.
    PlaneRow(const RenderResult& part, const IdRanks& ranks);

    /// Returns the names of the channels.
    [[nodiscard]] std::vector<std::string> channels() const;
    /// Returns a frame buffer that refers to this object.
    [[nodiscard]] Imf::FrameBuffer frame_buffer();
    /// Copies row `row` of the films, counted from the top of the region.
    void take(const RenderResult& part, int row);
    /// Adds the row to the films of `part`; the planes hold `samples` samples. Throws `Error`
    /// (invalid_input) for ids that no film has.
    void add_to(RenderResult& part, int row, std::int64_t samples) const;

private:
    [[nodiscard]] std::span<ExactSum::Words> plane_sums(std::size_t plane);
    [[nodiscard]] std::span<const ExactSum::Words> plane_sums(std::size_t plane) const;

    int left_;
    std::size_t width_;
    std::vector<std::string> film_;
    std::vector<std::string> aovs_;
    std::vector<std::string> strategies_;
    std::vector<std::string> ids_;
    IdRanks ranks_;
    std::vector<ExactSum::Words> words_;  // one row of each plane after the other
};

}  // namespace bdpt::io
