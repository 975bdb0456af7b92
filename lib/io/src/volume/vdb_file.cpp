#include "volume/vdb_file.h"

#include "file/companion.h"
#include "file/file_kind.h"
#include "file/read_file.h"
#include "volume/child_process.h"

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
        fmt::format("no OpenVDB file{}", kind ? fmt::format(", but {}", *kind) : std::string()));
}

std::filesystem::path find_reader()
{
    try {
        return companion_file(vdb_reader_name);
    } catch (const Error& error) {
        throw Error(error.code(), fmt::format("OpenVDB files are read by a program of its own: {}; "
                                              "the package bdpt-openvdb has it",
                                              error.what()));
    }
}

/// Libraries of OpenVDB start threads before anybody can ask them not to.
bool lacks_threads(const ProcessEnd& end)
{
    return end.message.find(std::generic_category().message(EAGAIN)) != std::string::npos;
}

/// What went wrong, where the reader ended before it had written everything.
[[noreturn]] void fail(const ProcessEnd& end, const ReadLimits& limits)
{
    if (end.signal == SIGXCPU) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("not read after {} s of a processor, but the limit is {} s",
                                limits.volume_seconds, limits.volume_seconds));
    }
    if (end.signal == SIGKILL) {
        throw Error(ErrorCode::out_of_memory,
                    fmt::format("{} was killed while it read, as systems do that lack memory",
                                vdb_reader_name));
    }
    if (end.signal == SIGABRT && lacks_threads(end)) {
        throw Error(ErrorCode::out_of_memory,
                    fmt::format("{} could not start its threads: the system limits how many this "
                                "user or container may have",
                                vdb_reader_name));
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

/// The size of what follows the header [values], which is checked once more: it comes from where
/// the file was.
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
    ChildProcess reader(find_reader(), {file.string(), options.grid.value_or(""),
                                        std::to_string(limits.volume_bytes),
                                        std::to_string(limits.volume_seconds)});
    VdbGrid grid;
    if (reader.read(&grid.header, sizeof(grid.header)) != sizeof(grid.header)) {
        fail(reader.wait(), limits);
    }
    grid.density.resize(checked_count(grid.header, limits));
    const std::size_t size = grid.density.size() * sizeof(float);
    if (reader.read(grid.density.data(), size) != size) {
        fail(reader.wait(), limits);
    }
    static_cast<void>(reader.wait());
    return grid;
}

}  // namespace bdpt::io
