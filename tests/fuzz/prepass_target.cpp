#include "fuzz_target.h"
#include "gltf/checks/checks.h"
#include "gltf/document/document.h"
#include "input_file.h"
#include "promises.h"

#include <algorithm>

using namespace bdpt;
using namespace bdpt::io;

namespace {

/// More than any size that has passed; 128 bits cannot overflow.
__extension__ typedef __int128 Wide;

Wide number(const Json& object, const char* key)
{
    return object.contains(key) ? static_cast<Wide>(object[key].get<std::uint64_t>()) : 0;
}

/// All bytes of a view are in its buffer; without trust in the code that checks the same.
void check_views(const CheckedGltf& checked)
{
    for (const Json& view : checked.document.value("bufferViews", Json::array())) {
        const auto buffer = view["buffer"].get<std::size_t>();
        fuzz::promise(buffer < checked.buffers.size(), "views have a buffer");
        fuzz::promise(number(view, "byteOffset") + number(view, "byteLength") <=
                          static_cast<Wide>(checked.buffers[buffer].size()),
                      "views lie within the bytes of their buffers");
    }
}

void check_range(const CheckedGltf& checked, const Json& view_index, Wide offset, Wide count,
                 Wide size)
{
    const Json& view = checked.document["bufferViews"].at(view_index.get<std::size_t>());
    const Wide stride = std::max(size, number(view, "byteStride"));
    fuzz::promise(offset + (count - 1) * stride + size <= number(view, "byteLength"),
                  "elements lie within their views");
}

void check_accessors(const CheckedGltf& checked)
{
    for (const Json& accessor : checked.document.value("accessors", Json::array())) {
        const auto bytes_of = [](const Json& code) {
            return static_cast<Wide>(component_size(code.get<std::uint64_t>()));
        };
        const Wide size = bytes_of(accessor["componentType"]) *
                          static_cast<Wide>(component_count(accessor["type"].get<std::string>()));
        if (accessor.contains("bufferView")) {
            check_range(checked, accessor["bufferView"], number(accessor, "byteOffset"),
                        number(accessor, "count"), size);
        }
        if (accessor.contains("sparse")) {
            const Json& sparse = accessor["sparse"];
            const Json& indices = sparse["indices"];
            const Json& values = sparse["values"];
            check_range(checked, indices["bufferView"], number(indices, "byteOffset"),
                        number(sparse, "count"), bytes_of(indices["componentType"]));
            check_range(checked, values["bufferView"], number(values, "byteOffset"),
                        number(sparse, "count"), size);
        }
    }
}

}  // namespace

/// All checks of a document, and the decoders of compressed meshes: what passes them is sound.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::InputFile input;
    const std::filesystem::path file = input.write(data, size);
    try {
        LoadContext context{.folders = {.own = file.parent_path()}, .limits = fuzz::small_limits};
        const CheckedGltf checked = read_checked_gltf(file, context);
        check_views(checked);
        check_accessors(checked);
    } catch (const Error& error) {
        fuzz::check_refusal(error);
    }
    return 0;
}
