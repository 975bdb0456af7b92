#pragma once

#include "file/memory_figures.h"

#include <bdpt/error.h>

#include <exception>
#include <filesystem>
#include <new>
#include <string>

namespace bdpt::io {

/// Returns what `read()` returns. All exceptions become an `Error` whose message begins with the
/// name of the file: an `Error` keeps its code, std::bad_alloc is out_of_memory with figures, all
/// others are internal.
template <typename Read>
[[nodiscard]] auto with_named_errors(const std::filesystem::path& file, const Read& read)
{
    const std::string prefix = file.string() + ": ";
    try {
        return read();
    } catch (const Error& error) {
        throw Error(error.code(), prefix + error.what());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::out_of_memory, prefix + "not enough memory: " + memory_figures());
    } catch (const std::exception& error) {
        throw Error(ErrorCode::internal, prefix + error.what());
    }
}

}  // namespace bdpt::io
