#pragma once

#include <bdpt/error.h>
#include <bdpt/image.h>
#include <fmt/core.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::python {

namespace nb = nanobind;

/// A NumPy array that owns its values.
using FloatArray = nb::ndarray<nb::numpy, float>;
/// Contiguous floats, as NumPy converts an argument.
template <typename... Shape>
using FloatInput = nb::ndarray<const float, nb::c_contig, nb::device::cpu, Shape...>;
/// An `Array`, or anything that NumPy can convert to one: other types of numbers, derived classes,
/// lists, renders.
template <typename Array>
struct ArrayLike {
    Array array;
};

template <typename... Shape>
using FloatsLike = ArrayLike<FloatInput<Shape...>>;
using ImageInput = FloatsLike<nb::shape<-1, -1, 3>>;

/// Moves `values`, each one `Number` or several, into an array of that shape, without copying.
template <typename Number, typename Value>
[[nodiscard]] nb::ndarray<nb::numpy, Number> to_array(
    std::vector<Value> values, const std::vector<std::size_t>& shape,
    const nb::dlpack::dtype& type = nb::dtype<Number>())
{
    auto* kept = new std::vector<Value>(std::move(values));
    const nb::capsule owner(
        kept, [](void* pointer) noexcept { delete static_cast<std::vector<Value>*>(pointer); });
    return {kept->data(), shape.size(), shape.data(), owner, nullptr, type};
}

/// Returns numbers as an array of that shape.
template <typename Number>
[[nodiscard]] nb::object to_numpy(std::vector<Number> values, const std::vector<std::size_t>& shape)
{
    return nb::cast(to_array<Number>(std::move(values), shape));
}

[[nodiscard]] inline FloatArray to_array(Image image)
{
    const auto height = static_cast<std::size_t>(image.height);
    const auto width = static_cast<std::size_t>(image.width);
    return to_array<float>(std::move(image.pixels), {height, width, 3});
}

[[nodiscard]] inline FloatArray to_array(Layer layer)
{
    const auto height = static_cast<std::size_t>(layer.height);
    const auto width = static_cast<std::size_t>(layer.width);
    const std::size_t channels = layer.channels.size();
    return to_array<float>(std::move(layer.values), {height, width, channels});
}

/// Copies texels to an array (height, width, channels) of uint8, uint16 or float32.
[[nodiscard]] inline nb::object to_array(const TexelImage& texels)
{
    const nb::dlpack::dtype type = texels.type == TexelType::unorm8    ? nb::dtype<std::uint8_t>()
                                   : texels.type == TexelType::unorm16 ? nb::dtype<std::uint16_t>()
                                                                       : nb::dtype<float>();
    return nb::cast(to_array<std::uint8_t>(
        texels.bytes,
        {static_cast<std::size_t>(texels.height), static_cast<std::size_t>(texels.width),
         static_cast<std::size_t>(texels.channels)},
        type));
}

/// Converts a number of pixels to a side of an image. Throws `Error` (usage) if it exceeds an
/// `int`.
[[nodiscard]] inline int to_side(std::size_t count)
{
    if (!std::in_range<int>(count)) {
        throw Error(ErrorCode::usage, fmt::format("an image has {} pixels a side", count));
    }
    return static_cast<int>(count);
}

[[nodiscard]] inline Image to_image(const ImageInput& input)
{
    const auto& array = input.array;
    const auto* pixels = reinterpret_cast<const Rgb*>(array.data());
    return {to_side(array.shape(1)), to_side(array.shape(0)),
            std::vector<Rgb>(pixels, pixels + array.shape(0) * array.shape(1))};
}

/// Converts rows of `Value::length()` numbers to vectors.
template <typename Value, typename Array>
[[nodiscard]] std::vector<Value> to_vectors(const Array& array)
{
    const auto* rows = reinterpret_cast<const Value*>(array.data());
    return std::vector<Value>(rows, rows + array.shape(0));
}

}  // namespace bdpt::python

namespace nanobind::detail {

template <typename Array>
struct type_caster<bdpt::python::ArrayLike<Array>> {
    NB_TYPE_CASTER(bdpt::python::ArrayLike<Array>, const_name("numpy.typing.ArrayLike"))

    bool from_python(handle source, std::uint8_t flags, cleanup_list* cleanup) noexcept
    {
        make_caster<Array> caster;
        if (caster.from_python(source, flags, cleanup)) {
            value.array = std::move(caster.value);
            return true;
        }
        if ((flags & static_cast<std::uint8_t>(cast_flags::convert)) == 0) {
            return false;
        }
        try {
            const object array = module_::import_("numpy").attr("asarray")(source);
            const auto kind = nanobind::cast<std::string>(array.attr("dtype").attr("kind"));
            // Not None, texts or complex numbers, which NumPy would convert to floats.
            if (kind == "b" || kind == "i" || kind == "u" || kind == "f") {
                if (caster.from_python(array, flags, cleanup)) {
                    value.array = std::move(caster.value);
                    return true;
                }
            }
        } catch (const python_error&) {  // such as rows of different lengths
        } catch (const std::exception&) {
        }
        return false;
    }
};

}  // namespace nanobind::detail
