#include "fuzz_target.h"
#include "gltf/checks/checks.h"
#include "promises.h"

using namespace bdpt;
using namespace bdpt::io;

namespace {

bool lies_within(const GlbChunks::Range& range, std::size_t size)
{
    return range.offset <= size && range.size <= size - range.offset;
}

}  // namespace

/// The frame of a GLB: chunks lie within the file and apart.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const ByteView file(data, size);
    static_cast<void>(is_glb(file));
    try {
        LoadContext context;
        const GlbChunks chunks = find_glb_chunks(file, context);
        fuzz::promise(lies_within(chunks.json, size), "the JSON chunk lies within the file");
        if (chunks.bin) {
            fuzz::promise(lies_within(*chunks.bin, size), "the BIN chunk lies within the file");
            fuzz::promise(chunks.bin->offset >= chunks.json.offset + chunks.json.size,
                          "chunks lie apart");
        }
    } catch (const Error& error) {
        fuzz::check_refusal(error);
    }
    return 0;
}
