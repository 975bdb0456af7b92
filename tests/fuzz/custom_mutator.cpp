#include "mutator.h"

#include <algorithm>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// Called by libFuzzer: half of the time its own changes, which know what was reached, else ours,
/// which know formats.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed)
{
    if (seed % 2 == 0) {
        return LLVMFuzzerMutate(data, size, most);
    }
    const std::vector<std::uint8_t> bytes = bdpt::fuzz::mutate({data, size}, seed, most);
    std::copy(bytes.begin(), bytes.end(), data);
    return bytes.size();
}
