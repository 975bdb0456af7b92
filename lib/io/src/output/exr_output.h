#pragma once

#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <bdpt/film/id_film.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/write_image.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace bdpt::io {

// `origin` is that of the world, which cameras are in, in the coordinates of the file
// (`SceneDesc::origin`), which are the world of other programs.

/// Returns the file's coordinates to the camera space of OpenEXR's attribute "worldToCamera":
/// left-handed, +x right, +y up, +z into the image [OpenEXR standard attributes].
[[nodiscard]] Mat4 camera_from_file(const CameraDesc& camera, const DVec3& origin);

/// Returns the file's coordinates to the space of OpenEXR's attribute "worldToNDC": after the
/// division by w, (0, 0) is the upper left corner of the image and (1, 1) the lower right one.
/// `aspect` is width over height.
[[nodiscard]] Mat4 ndc_from_file(const CameraDesc& camera, const DVec3& origin, float aspect);

/// Adds the metadata common to all our OpenEXR files. `aspect`: width over height of the whole
/// image.
void add_exr_metadata(Imf::Header& header, const ImageMetadata& metadata, float aspect);

/// Adds the metadata that readers of Cryptomatte look for to `header`, for those layers that it has
/// channels of: "cryptomatte/KEY/name", ".../hash", ".../conversion" and ".../manifest"
/// [Cryptomatte specification 1.2.0, "Metadata"].
void add_cryptomatte_metadata(Imf::Header& header, std::span<const IdManifest> manifests);

/// Lets OpenEXR write into an `OutputFile`, which reports errors that it would swallow.
class ExrStream : public Imf::OStream {
public:
    ExrStream(OutputFile& file, const std::string& name) : Imf::OStream(name.c_str()), file_(file)
    {}
    void write(const char bytes[], int count) override
    {
        file_.write({bytes, static_cast<std::size_t>(count)});
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }

private:
    OutputFile& file_;
};

}  // namespace bdpt::io
