#pragma once

#include <array>
#include <cstdint>

// What the program bdpt-read-ktx is given, and what it answers:
//
//     bdpt-read-ktx LIBRARY
//     bdpt-read-ktx LIBRARY WIDTH HEIGHT CHANNELS MEMORY SECONDS < IMAGE.ktx2
//
// LIBRARY is libktx or its folder; empty: what the system finds. WIDTH, HEIGHT and CHANNELS are
// what the header of the image says, MEMORY is how much decoding may take, SECONDS how long it may
// keep a processor. On its standard output the program writes a `KtxReply` when it has opened the
// library, and then the texels. If there is an error, it writes a line to its standard error and
// ends with an `ErrorCode`.

namespace bdpt::io {

constexpr const char* ktx_reader_name = "bdpt-read-ktx";

/// Changes when anything in this file does.
constexpr std::array<char, 8> ktx_reply_start{'b', 'd', 'p', 't', 'k', 't', 'x', '1'};

/// Followed by texels of 8 bits a channel, row after row from the top.
struct KtxReply {
    std::array<char, 8> start = ktx_reply_start;
};

}  // namespace bdpt::io
