#pragma once

#include <bdpt/error.h>
#include <nanobind/nanobind.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace bdpt::python {

/// Error of a call: a value of a wrong type, or an unknown keyword. In Python it is also a
/// TypeError.
class CallError : public Error {
public:
    explicit CallError(const std::string& message) : Error(ErrorCode::usage, message) {}
};

/// Error of a value. In Python it is also a ValueError.
class ValueError : public Error {
public:
    explicit ValueError(const std::string& message) : Error(ErrorCode::usage, message) {}
};

/// Error of a file that does not exist. In Python it is also a FileNotFoundError with `filename`.
class MissingFile : public Error {
public:
    MissingFile(const Error& error, std::filesystem::path missing)
        : Error(error), file(std::move(missing))
    {}
    std::filesystem::path file;
};

/// Returns the result of `work`. If it throws the `Error` of a missing file and one of `files` does
/// not exist, `MissingFile` says so.
template <typename Work>
auto with_missing_file(const std::vector<std::filesystem::path>& files, const Work& work)
{
    try {
        return work();
    } catch (const Error& error) {
        const auto is_missing = [](const std::filesystem::path& file) {
            std::error_code unknown;
            return !std::filesystem::exists(file, unknown);
        };
        const auto missing = std::find_if(files.begin(), files.end(), is_missing);
        if (error.code() == ErrorCode::not_found && missing != files.end()) {
            throw MissingFile(error, *missing);
        }
        throw;
    }
}

/// Returns a value of Python as it is written there, on one line and not longer than a message
/// should be.
[[nodiscard]] std::string written(nanobind::handle value);

/// Throws the `CallError` of an unknown keyword: "render() got an unexpected keyword argument
/// 'sppp'; did you mean 'spp'?"
[[noreturn]] void fail_keyword(std::string_view call, std::string_view keyword,
                               const std::optional<std::string>& meant);

/// Throws the `UnknownName`: "no material "gol" (did you mean "gold"?)".
[[noreturn]] void fail_name(std::string_view kind, const std::string& name,
                            const std::vector<std::string>& known);

/// Binds `Error` and the classes derived from it, and translates C++'s `Error` to them.
void bind_errors(nanobind::module_& module);

}  // namespace bdpt::python
