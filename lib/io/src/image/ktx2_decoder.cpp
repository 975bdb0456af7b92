#include "image/ktx2_decoder.h"

#include "file/companion.h"
#include "image/ktx_reply.h"
#include "process/child_process.h"

#include <bdpt/error.h>

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace bdpt::io {

namespace {

/// Limits of decoding.
struct DecodingLimits {
    std::uint64_t memory;   // [bytes]
    std::uint64_t seconds;  // CPU time [s]
};

DecodingLimits decoding_limits(ByteView file, const Ktx2Header& header)
{
    constexpr std::uint64_t start_seconds = 10;
    // A tenth of the speed of a slow machine.
    constexpr std::uint64_t pixels_per_second = 2'000'000;
    return {.memory = decoding_memory(file, header),
            .seconds = start_seconds + header.pixels / pixels_per_second};
}

/// Returns the program's message without its name; empty if it did not write one.
std::string own_message(const ProcessEnd& end)
{
    constexpr std::string_view own = "bdpt-read-ktx: ";
    return end.message.starts_with(own) ? end.message.substr(own.size()) : std::string();
}

[[noreturn]] void fail(const ProcessEnd& end, const DecodingLimits& limits)
{
    if (end.signal == SIGXCPU) {
        throw std::runtime_error(
            fmt::format("KTX2: broken, or too large: not decoded after {} s of a processor, the "
                        "limit for an image of its size",
                        limits.seconds));
    }
    if (end.signal == SIGKILL) {
        throw Error(ErrorCode::out_of_memory,
                    fmt::format("{} was killed while decoding, probably for lack of memory",
                                ktx_reader_name));
    }
    if (end.signal == SIGSYS) {
        throw std::runtime_error(
            "KTX2: broken: libktx was stopped when it did what decoding does not need");
    }
    if (end.signal != 0) {
        throw std::runtime_error(
            fmt::format("KTX2: broken: libktx crashed on it (signal {})", end.signal));
    }
    const std::string message = own_message(end);
    throw std::runtime_error(
        "KTX2: " + (message.empty() ? fmt::format("{} ended with code {}: {}", ktx_reader_name,
                                                  end.exit_code, end.message)
                                    : message));
}

/// Tests whether the program has opened the library.
bool is_ready(ChildProcess& reader)
{
    KtxReply reply{.start = {}};
    return reader.read(&reply, sizeof(reply)) == sizeof(reply) && reply.start == ktx_reply_start;
}

std::optional<std::string> find_obstacle(const std::string& library)
{
    try {
        ChildProcess reader(companion_file(ktx_reader_name), {library});
        if (is_ready(reader)) {
            return std::nullopt;
        }
        const ProcessEnd end = reader.wait();
        const std::string message = own_message(end);
        return !message.empty() ? message
               : end.signal != 0
                   ? fmt::format("libktx crashed when it was opened (signal {})", end.signal)
                   : fmt::format("{} is of another version, or broken: {}", ktx_reader_name,
                                 end.message);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::unsupported) {
            throw;
        }
        return fmt::format("KTX2 images are read by a separate program: {}", error.what());
    }
}

}  // namespace

std::uint64_t decoding_memory(ByteView file, const Ktx2Header& header)
{
    // The file, its levels without supercompression, as RGBA, and the output.
    constexpr std::uint64_t bytes_per_pixel = 16;
    return 2 * file.size() + bytes_per_pixel * header.pixels;
}

Ktx2Decoder::Ktx2Decoder(const std::optional<std::filesystem::path>& library)
    : library_(library ? library->string() : std::string())
{}

const std::string* Ktx2Decoder::obstacle()
{
    if (!is_known_) {
        obstacle_ = find_obstacle(library_);
        is_known_ = true;
    }
    return obstacle_ ? &*obstacle_ : nullptr;
}

void Ktx2Decoder::decode(ByteView file, const Ktx2Header& header, std::uint8_t* texels) const
{
    const DecodingLimits limits = decoding_limits(file, header);
    ChildProcess reader(companion_file(ktx_reader_name),
                        {library_, std::to_string(header.width), std::to_string(header.height),
                         std::to_string(header.channels), std::to_string(limits.memory),
                         std::to_string(limits.seconds)},
                        file);
    const std::size_t size = static_cast<std::size_t>(header.width) *
                             static_cast<std::size_t>(header.height) *
                             static_cast<std::size_t>(header.channels);
    if (!is_ready(reader) || reader.read(texels, size) != size) {
        fail(reader.wait(), limits);
    }
    static_cast<void>(reader.wait());
}

}  // namespace bdpt::io
