#pragma once

#include <nanobind/nanobind.h>

#include <filesystem>
#include <optional>

namespace bdpt::python {

/// All of `file`.
[[nodiscard]] nanobind::bytes read_bytes(const std::filesystem::path& file);

/// Creates `file`.
void write_bytes(const std::filesystem::path& file, const nanobind::bytes& contents);

/// A path as os.fspath() takes it. Raises TypeError for others.
[[nodiscard]] std::filesystem::path to_path(nanobind::handle value);

/// What is in memory: bytes, what has their interface, or what read() gives. None: it is a path.
[[nodiscard]] std::optional<nanobind::bytes> contents_of(nanobind::handle value);

/// Is it a file that is written into by write()?
[[nodiscard]] bool is_writable_object(nanobind::handle value);

}  // namespace bdpt::python
