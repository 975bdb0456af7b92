#pragma once

#include <bdpt/error.h>

#include <exception>
#include <filesystem>
#include <new>

namespace bdpt::io {

/// Calls `write()`, which writes `file`. Exceptions of libraries become an `Error` (output) that
/// names the file; an `Error` and std::bad_alloc are passed on.
template <typename Write>
void with_write_errors(const std::filesystem::path& file, const Write& write)
{
    try {
        write();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& failure) {
        throw Error(ErrorCode::output, file.string() + ": cannot write: " + failure.what());
    }
}

}  // namespace bdpt::io
