#include "volume/vdb_file.h"

#include "file/companion.h"
#include "file/file_kind.h"
#include "file/read_file.h"
#include "process/child_process.h"

#include <bdpt/error.h>

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>

namespace bdpt::io {

namespace {

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
    throw Error(
        start.empty() ? ErrorCode::invalid_input : ErrorCode::unsupported,
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

}  // namespace

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

}  // namespace bdpt::io
