#pragma once

#include <OpenEXR/ImfFrameBuffer.h>
#include <bdpt/aov.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/io/json_value.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/part_file.h>
#include <bdpt/part/content_hash.h>
#include <bdpt/part/render_result.h>
#include <bdpt/render_stats.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

// JSON of a part's ids: [{"ranks": 3, "names": [["lamp", 1083263012], ...]}, ...], for each kind.
// Ids are stored beside their names, as JSON changes names that are not UTF-8.

[[nodiscard]] nlohmann::ordered_json ids_to_json(const IdNames& names, const IdRanks& ranks);

/// Parses names. Throws as `JsonValue` does, also for ids that no name has.
[[nodiscard]] IdNames names_from_json(const JsonValue& json);

/// Parses ranks. Throws as `JsonValue` does.
[[nodiscard]] IdRanks ranks_from_json(const JsonValue& json);

// A part file ends with a seal, behind the data of OpenEXR: 16 letters, the length of what is
// before it, and the hash of that. So a file that is truncated, or of which a single bit has
// changed, is detected before any of it is used.

/// An open part file with a valid seal.
class SealedFile {
public:
    /// Opens and checks a file. Throws `Error`: not_found, or invalid_input if the seal is not
    /// valid. Messages do not name the file.
    explicit SealedFile(const std::filesystem::path& file);
    ~SealedFile();
    SealedFile(const SealedFile&) = delete;
    SealedFile& operator=(const SealedFile&) = delete;

    /// Returns the size without the seal.
    [[nodiscard]] std::uint64_t size() const { return size_; }
    [[nodiscard]] const ContentHash& hash() const { return hash_; }
    /// Reads bytes. Throws `Error` (invalid_input) beyond the end.
    void read(std::uint64_t position, std::span<char> bytes) const;

private:
    void check();

    int descriptor_ = -1;
    std::uint64_t size_ = 0;
    ContentHash hash_;
};

/// Appends the seal to `file`, which has `size` bytes.
void seal(OutputFile& file, std::uint64_t size);

/// The contents of a part file except its sums: its JSON.
struct PartHeader {
    Identity identity;
    SampleSet samples;
    FilmLayout layout;
    AovSet aovs;
    PixelCounts counts = PixelCounts::equal;
    IdNames names;    ///< names in the AOVs that are images of ids
    IdRanks ranks{};  ///< ranks that the file has planes for
    std::vector<Strategy> strategies;
    FilmTotals totals;
    RenderStats stats;
    double cpu_seconds = 0.0;
    PartNotes notes;
};

[[nodiscard]] PartHeader make_part_header(const RenderResult& part, const PartNotes& notes);

[[nodiscard]] std::string to_text(const PartHeader& header);

/// Parses a header. Throws `Error` (invalid_input) for anything that no part has.
[[nodiscard]] PartHeader parse_part_header(std::string_view text);

/// Creates a part without samples that has films as `header` describes.
[[nodiscard]] RenderResult make_part(const PartHeader& header);

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
