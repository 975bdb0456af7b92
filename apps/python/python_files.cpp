#include "python_files.h"

#include <bdpt/error.h>
#include <fmt/core.h>
#include <nanobind/stl/filesystem.h>

#include <fstream>
#include <iterator>

namespace bdpt::python {

namespace nb = nanobind;
namespace fs = std::filesystem;

nb::bytes read_bytes(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    return nb::bytes(bytes.data(), bytes.size());
}

void write_bytes(const fs::path& file, const nb::bytes& contents)
{
    std::ofstream stream(file, std::ios::binary);
    stream.write(contents.c_str(), static_cast<std::streamsize>(contents.size()));
    stream.close();
    if (!stream) {
        throw Error(ErrorCode::output, fmt::format("{}: cannot write", file.string()));
    }
}

fs::path to_path(nb::handle value)
{
    const nb::object path = nb::steal(PyOS_FSPath(value.ptr()));
    if (!path.is_valid()) {
        throw nb::python_error();
    }
    return nb::cast<fs::path>(path);
}

std::optional<nb::bytes> read_contents(nb::handle value)
{
    if (nb::hasattr(value, "__fspath__") || PyUnicode_Check(value.ptr()) != 0) {
        return std::nullopt;
    }
    nb::object contents = nb::borrow(value);
    if (nb::hasattr(value, "read")) {
        contents = value.attr("read")();
        if (PyUnicode_Check(contents.ptr()) != 0) {
            throw nb::type_error("read() returns text: open the file in mode \"rb\"");
        }
    }
    if (PyObject_CheckBuffer(contents.ptr()) == 0) {
        return std::nullopt;
    }
    const nb::object bytes = nb::steal(PyBytes_FromObject(contents.ptr()));
    if (!bytes.is_valid()) {
        throw nb::python_error();
    }
    return nb::cast<nb::bytes>(bytes);
}

bool is_writable_object(nb::handle value)
{
    return nb::hasattr(value, "write") && !nb::hasattr(value, "__fspath__");
}

}  // namespace bdpt::python
