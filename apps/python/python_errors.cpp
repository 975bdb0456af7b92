#include "python_errors.h"

#include <fmt/core.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <exception>

#include "options/option_list.h"
#include "words.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

/// A class of errors derived from `Error`, in Python and of those that it is for in C++.
struct Subclass {
    const char* name;
    PyObject* base;  ///< exception of Python
    const char* text;
    bool (*is_for)(const Error& error);
};

template <ErrorCode... codes>
bool has_code(const Error& error)
{
    return ((error.code() == codes) || ...);
}

/// The first that is for an error is its class.
std::array<Subclass, 5> subclasses()
{
    return {
        {{"InvalidCallError", PyExc_TypeError, "A value of a wrong type, or an unknown keyword.",
          [](const Error& error) { return dynamic_cast<const CallError*>(&error) != nullptr; }},
         {"InvalidValueError", PyExc_ValueError, "A value, or a file, that is not valid.",
          [](const Error& error) {
              return dynamic_cast<const job::UnknownName*>(&error) != nullptr ||
                     has_code<ErrorCode::usage, ErrorCode::invalid_input>(error);
          }},
         {"MissingFileError", PyExc_FileNotFoundError,
          "A file that does not exist or cannot be read. `filename` is None if it is not known.",
          has_code<ErrorCode::not_found>},
         {"OutputError", PyExc_OSError, "A file that cannot be written.",
          has_code<ErrorCode::output>},
         {"OutOfMemoryError", PyExc_MemoryError, "Memory that is not there, or not allowed.",
          has_code<ErrorCode::out_of_memory>}}};
}

/// The classes, and `Error` last. Lives as long as the module.
std::array<nb::object*, 6> error_types{};

/// Translates bdpt::Error to bdpt.Error, whose `code` is the exit code of the command.
void translate(const std::exception_ptr& exception, void* /*payload*/)
{
    try {
        std::rethrow_exception(exception);
    } catch (const Error& error) {
        const auto classes = subclasses();
        const auto* const found =
            std::find_if(classes.begin(), classes.end(),
                         [&error](const Subclass& kind) { return kind.is_for(error); });
        const nb::object& type = *error_types.at(static_cast<std::size_t>(found - classes.begin()));
        nb::object raised = type(in_keywords(error.what()));
        raised.attr("code") = static_cast<int>(error.code());
        if (const auto* const missing = dynamic_cast<const MissingFile*>(&error)) {
            raised.attr("filename") = missing->file.string();
        }
        PyErr_SetObject(type.ptr(), raised.ptr());
    }
}

}  // namespace

std::string written(nb::handle value)
{
    constexpr std::size_t longest = 80;
    auto text = nb::cast<std::string>(nb::repr(value));
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.size() <= longest
               ? text
               : fmt::format("<{}>", nb::cast<std::string>(value.type().attr("__name__")));
}

void fail_keyword(std::string_view call, std::string_view keyword,
                  const std::optional<std::string>& meant)
{
    throw CallError(fmt::format("{} got an unexpected keyword argument '{}'{}", call, keyword,
                                meant ? fmt::format("; did you mean '{}'?", *meant) : ""));
}

void fail_name(std::string_view kind, const std::string& name,
               const std::vector<std::string>& known)
{
    const auto meant = job::closest(name, known);
    throw job::UnknownName(fmt::format(
        "no {} \"{}\"{}", kind, name, meant ? fmt::format(" (did you mean \"{}\"?)", *meant) : ""));
}

void bind_errors(nb::module_& module)
{
    // The module may be imported without the package, but pickles name the package.
    nb::object error = nb::steal(PyErr_NewExceptionWithDoc(
        "bdpt.Error",
        "Invalid input, or a failure of a library; `code` is the exit code of the command.",
        PyExc_RuntimeError, nullptr));
    module.attr("Error") = error;
    error_types.back() = new nb::object(error);
    std::size_t number = 0;
    for (const Subclass& kind : subclasses()) {
        nb::dict members;
        if (kind.base == PyExc_FileNotFoundError) {
            // Not those of OSError, which would become a part of the message and miss in pickles.
            members["filename"] = nb::none();
            members["errno"] = ENOENT;
        }
        const nb::object bases = nb::make_tuple(error, nb::borrow(kind.base));
        nb::object type = nb::steal(PyErr_NewExceptionWithDoc(
            fmt::format("bdpt.{}", kind.name).c_str(), kind.text, bases.ptr(), members.ptr()));
        module.attr(kind.name) = type;
        error_types.at(number++) = new nb::object(type);
    }
    nb::register_exception_translator(translate);
}

}  // namespace bdpt::python
