#pragma once

#include <cstddef>
#include <cstdint>

/// What a fuzzer calls with bytes that nobody trusts; each target defines it. Whatever the bytes
/// are, it returns 0. It aborts when a promise of the code under test is broken; sanitizers see to
/// the rest [libFuzzer's interface].
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
