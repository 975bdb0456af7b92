#include <bdpt/io/volume.h>

#include <bdpt/error.h>
#include <fmt/format.h>
#include <signal.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "file/messages.h"
#include "file/read_file.h"
#include "process/child_process.h"
#include "process/reader_program.h"

namespace bdpt::io {
namespace {

/// A grid as stored in a file.
struct VdbGrid {
    VdbReply header;
    std::vector<float> density;  ///< x fastest
};

using namespace std::string_view_literals;

/// Limits of reading a file.
struct ReadingLimits {
    std::uint64_t memory;   // of the tree of its grid [bytes]
    std::uint64_t seconds;  // CPU time [s]
};

ReadingLimits reading_limits(std::uint64_t file_bytes, const VolumeOptions& options)
{
    // Each node of a tree stores its masks uncompressed: if all values are compressed away, a leaf
    // of doubles grows 32 times, an inner node 33 times.
    constexpr std::uint64_t max_growth = 40;
    constexpr std::uint64_t start_seconds = 10;
    constexpr std::uint64_t bytes_per_second = 1'000'000;  // a tenth of the speed of a slow machine
    // A tree may be larger than the resulting box: its leaves are full, and may be doubles.
    const std::uint64_t growth = std::min(max_growth, UINT64_MAX / (file_bytes + 1));
    const std::uint64_t left = options.memory ? options.memory->left() : UINT64_MAX;
    const ReadLimits& limits = options.limits;
    return {
        .memory = std::min(
            {growth * file_bytes, 3 * std::min(limits.volume_bytes, UINT64_MAX / 3), left}),
        .seconds = std::min(limits.volume_seconds, start_seconds + file_bytes / bytes_per_second)};
}

void check_start(const std::filesystem::path& file, const ReadLimits& limits)
{
    constexpr std::string_view magic = " BDV\0\0\0\0"sv;
    const Bytes start = read_file(file, limits.file_bytes, 64);
    if (start.size() >= magic.size() && std::equal(magic.begin(), magic.end(), start.begin())) {
        return;
    }
    const auto kind = other_kind(start);
    throw Error(start.empty() ? ErrorCode::invalid_input : ErrorCode::unsupported,
                fmt::format("not an OpenVDB file{}",
                            kind ? fmt::format(", but {}", *kind) : std::string()));
}

std::filesystem::path find_reader()
{
    try {
        return companion_file(vdb_reader_name);
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("OpenVDB files are read by a separate program: {}; "
                                              "the package bdpt-openvdb contains it",
                                              error.what()));
    }
}

/// Tests for a failure to start threads: libraries of OpenVDB start some before they can be told
/// not to.
bool lacks_threads(const ProcessEnd& end)
{
    return end.message.find(std::generic_category().message(EAGAIN)) != std::string::npos;
}

/// Throws the error of a reader that ended before it had written everything.
[[noreturn]] void fail(const ProcessEnd& end, const ReadingLimits& limits)
{
    if (end.signal == SIGXCPU) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("broken, or too large: not read after {} s of a processor, the "
                                "limit for a file of its size",
                                limits.seconds));
    }
    if (end.signal == SIGKILL) {
        throw Error(ErrorCode::out_of_memory,
                    fmt::format("{} was killed while reading, probably for lack of memory",
                                vdb_reader_name));
    }
    if (end.signal == SIGABRT && lacks_threads(end)) {
        throw Error(ErrorCode::out_of_memory,
                    fmt::format("{} could not start its threads: the system limits how many this "
                                "user or container may have",
                                vdb_reader_name));
    }
    if (end.signal == SIGSYS) {
        throw Error(ErrorCode::invalid_input,
                    "broken: OpenVDB was stopped when it did what reading does not need");
    }
    if (end.signal != 0) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("broken: OpenVDB crashed on it (signal {})", end.signal));
    }
    const auto code = static_cast<ErrorCode>(end.exit_code);
    constexpr std::string_view own = "bdpt-read-vdb: ";
    if (std::string_view(end.message).starts_with(own)) {
        const bool known = code == ErrorCode::not_found || code == ErrorCode::unsupported;
        throw Error(known ? code : ErrorCode::invalid_input, end.message.substr(own.size()));
    }
    throw Error(ErrorCode::unsupported,
                fmt::format("{} cannot read it: it ended with code {}{}{}", vdb_reader_name,
                            end.exit_code, end.message.empty() ? "" : ": ", end.message));
}

/// Returns the number of values after the header, which is checked once more, as it comes from the
/// process that read the file.
std::size_t checked_count(const VdbReply& header, const ReadLimits& limits)
{
    std::uint64_t count = 1;
    for (const std::uint32_t side : header.size) {
        count = side == 0 || side > (1U << 20U) ? 0 : count * side;
    }
    const bool named = std::count(header.name.begin(), header.name.end(), '\0') > 0;
    if (header.start != vdb_reply_start || !named || count == 0 ||
        count > limits.volume_bytes / sizeof(float)) {
        throw Error(ErrorCode::internal,
                    fmt::format("{} is of another version, or broken", vdb_reader_name));
    }
    return static_cast<std::size_t>(count);
}

/// Reads a grid of an OpenVDB file, by a separate process. Throws `Error` as `load_volume` does,
/// without the name of the file.
VdbGrid read_vdb(const std::filesystem::path& file, const VolumeOptions& options)
{
    const ReadLimits& limits = options.limits;
    check_start(file, limits);
    const ReadingLimits allowed = reading_limits(std::filesystem::file_size(file), options);
    ChildProcess reader(
        find_reader(),
        {file.string(), options.grid.value_or(""), std::to_string(limits.volume_bytes),
         std::to_string(allowed.memory), std::to_string(allowed.seconds)});
    VdbGrid grid;
    if (reader.read(&grid.header, sizeof(grid.header)) != sizeof(grid.header)) {
        fail(reader.wait(), allowed);
    }
    const std::size_t count = checked_count(grid.header, limits);
    if (options.memory) {
        constexpr std::uint64_t voxel = sizeof(float);
        const std::string what = fmt::format("grid \"{}\"", grid.header.name.data());
        options.memory->spend(what, count * voxel);
        options.memory->check(what + " while it is read",
                              std::min(grid.header.tree_bytes, allowed.memory));
    }
    grid.density.resize(count);
    const std::size_t size = grid.density.size() * sizeof(float);
    if (reader.read(grid.density.data(), size) != size) {
        fail(reader.wait(), allowed);
    }
    static_cast<void>(reader.wait());
    return grid;
}

/// Converts from the axes of the file to those of scenes.
glm::dmat4 turned_up(UpAxis up)
{
    glm::dmat4 turn(1.0);
    if (up == UpAxis::z) {
        turn[1] = {0, 0, -1, 0};
        turn[2] = {0, 1, 0, 0};
    }
    return turn;
}

/// Maps grid indices to the world, with voxel `first` at (0, 0, 0). Indices of OpenVDB are centres
/// of voxels, ours their lower corners.
glm::dmat4 world_from_grid(const VdbReply& header, UpAxis up)
{
    const glm::dvec3 first(header.first[0], header.first[1], header.first[2]);
    const glm::dmat4 precise = turned_up(up) * glm::make_mat4(header.world_from_index.data()) *
                               glm::translate(glm::dmat4(1.0), first - 0.5);
    const Mat4 matrix(precise);
    const float determinant = glm::determinant(glm::mat3(matrix));
    bool finite = std::isnormal(determinant);
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            finite = finite && std::isfinite(matrix[column][row]);
        }
    }
    if (!finite) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("grid \"{}\": its transform cannot be inverted in single "
                                "precision (determinant {})",
                                header.name.data(), determinant));
    }
    return precise;
}

std::string voxel_label(const VdbReply& header, std::size_t index)
{
    const std::size_t width = header.size[0];
    const std::size_t height = header.size[1];
    const std::array place{index % width, index / width % height, index / (width * height)};
    std::array<std::int64_t, 3> voxel{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        voxel[axis] = header.first[axis] + static_cast<std::int64_t>(place[axis]);
    }
    return fmt::format("grid \"{}\": voxel ({}, {}, {})", header.name.data(), voxel[0], voxel[1],
                       voxel[2]);
}

/// Makes densities finite and non-negative; returns the warnings about them.
std::vector<std::string> mend(VdbGrid& grid)
{
    std::string first;
    std::size_t count = 0;
    for (std::size_t i = 0; i < grid.density.size(); ++i) {
        float& value = grid.density[i];
        if (value >= 0.0f && std::isfinite(value)) {
            continue;
        }
        if (value > 0.0f) {
            throw Error(ErrorCode::invalid_input,
                        voxel_label(grid.header, i) + ": an infinite density");
        }
        if (count == 0) {
            first = fmt::format("{}: {}", voxel_label(grid.header, i), value);
        }
        ++count;
        value = 0.0f;
    }
    std::vector<std::string> warnings;
    if (count > 0) {
        warnings.push_back(
            fmt::format("{}: negative and NaN densities are treated as 0{}", first,
                        count > 1 ? fmt::format(" (and {} more of this kind)", count - 1) : ""));
    }
    if (grid.header.empty != 0) {
        std::fill(grid.density.begin(), grid.density.end(), 0.0f);
        warnings.push_back(fmt::format("grid \"{}\": it has no active voxels, so nothing is there",
                                       grid.header.name.data()));
    }
    return warnings;
}

LoadedVolume load(const std::filesystem::path& file, const VolumeOptions& options)
{
    VdbGrid grid = read_vdb(file, options);
    LoadedVolume loaded;
    loaded.warnings = mend(grid);
    VolumeDesc& volume = loaded.volume;
    volume.name = grid.header.name.data();
    volume.size = {grid.header.size[0], grid.header.size[1], grid.header.size[2]};
    const glm::dmat4 transform = world_from_grid(grid.header, options.up);
    volume.world_from_grid = Mat4(transform);
    loaded.translation = DVec3(transform[3]);
    volume.density = std::move(grid.density);
    volume.extinction = options.extinction;
    volume.albedo = options.albedo;
    volume.anisotropy = options.anisotropy;
    return loaded;
}

}  // namespace

LoadedVolume load_volume(const std::filesystem::path& file, const VolumeOptions& options)
{
    return with_named_errors(file, [&] { return load(file, options); });
}

}  // namespace bdpt::io
