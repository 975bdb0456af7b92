#pragma once

#include <array>
#include <cstdint>

// Arguments and output of the program bdpt-read-ktx:
//
//     bdpt-read-ktx LIBRARY
//     bdpt-read-ktx LIBRARY WIDTH HEIGHT CHANNELS MEMORY SECONDS < IMAGE.ktx2
//
// LIBRARY is libktx or its folder; empty: the one that the system finds. WIDTH, HEIGHT and CHANNELS
// are those of the image's header, MEMORY and SECONDS (of CPU time) are limits of decoding. On its
// standard output the program writes a `KtxReply` when it has opened the library, and then the
// texels. On an error, it writes a line to its standard error and exits with an `ErrorCode`.

namespace bdpt::io {

constexpr const char* ktx_reader_name = "bdpt-read-ktx";

/// Changes whenever anything in this file does.
constexpr std::array<char, 8> ktx_reply_start{'b', 'd', 'p', 't', 'k', 't', 'x', '1'};

/// Header of the reply, followed by texels of 8 bits a channel, row by row from the top.
struct KtxReply {
    std::array<char, 8> start = ktx_reply_start;
};

}  // namespace bdpt::io
