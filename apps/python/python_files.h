#pragma once

#include <nanobind/nanobind.h>

#include <filesystem>
#include <optional>

namespace bdpt::python {

/// Reads all of `file`.
[[nodiscard]] nanobind::bytes read_bytes(const std::filesystem::path& file);

/// Creates `file`.
void write_bytes(const std::filesystem::path& file, const nanobind::bytes& contents);

/// Converts a path like os.fspath(). Raises TypeError for other objects.
[[nodiscard]] std::filesystem::path to_path(nanobind::handle value);

/// Returns contents in memory: bytes, objects with their interface, or the result of read(). None:
/// `value` is a path.
[[nodiscard]] std::optional<nanobind::bytes> read_contents(nanobind::handle value);

/// Tests whether `value` is a file object with write().
[[nodiscard]] bool is_writable_object(nanobind::handle value);

}  // namespace bdpt::python
