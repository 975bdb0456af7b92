#include <bdpt/eval/comparison.h>

#include <bdpt/error.h>
#include <bdpt/io/read_image.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string>
#include <system_error>
#include <utility>

#include "metrics/metric_parts.h"

namespace bdpt::eval {

namespace {

namespace fs = std::filesystem;

bool is_image(const fs::directory_entry& entry)
{
    std::string extension = entry.path().extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::error_code ignored;
    return entry.is_regular_file(ignored) && (extension == ".exr" || extension == ".hdr") &&
           !entry.path().filename().string().starts_with(".");
}

bool same_file(const fs::path& a, const fs::path& b)
{
    std::error_code missing;
    return fs::equivalent(a, b, missing);
}

}  // namespace

std::vector<fs::path> seed_files(const fs::path& path, const fs::path& reference)
{
    std::error_code failure;
    if (!fs::is_directory(path, failure)) {
        return {path};
    }
    std::vector<fs::path> files;
    for (auto entry = fs::directory_iterator(path, failure);
         !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
        if (is_image(*entry) && !same_file(entry->path(), reference)) {
            files.push_back(entry->path());
        }
    }
    if (failure) {
        throw Error(ErrorCode::not_found, path.string() + ": " + failure.message());
    }
    if (files.empty()) {
        throw Error(ErrorCode::not_found, path.string() +
                                              ": the folder has no .exr or .hdr file beside the "
                                              "reference");
    }
    std::sort(files.begin(), files.end());
    return files;
}

namespace {

namespace fs = std::filesystem;

PixelRect intersection(const PixelRect& a, const PixelRect& b)
{
    return {.x0 = std::max(a.x0, b.x0),
            .y0 = std::max(a.y0, b.y0),
            .x1 = std::min(a.x1, b.x1),
            .y1 = std::min(a.y1, b.y1)};
}

Image crop(const Image& image, const PixelRect& region)
{
    if (region.width() == image.width && region.height() == image.height) {
        return image;
    }
    Image result{region.width(), region.height(), {}};
    for (int y = region.y0; y < region.y1; ++y) {
        for (int x = region.x0; x < region.x1; ++x) {
            result.pixels.push_back(image.at(x, y));
        }
    }
    return result;
}

std::string to_text(const PixelRect& rect)
{
    return std::to_string(rect.x0) + "," + std::to_string(rect.y0) + "," + std::to_string(rect.x1) +
           "," + std::to_string(rect.y1);
}

/// An image and its name.
struct NamedImage {
    std::string name;
    Image image;
    PixelRect filled;
};

class Reader {
public:
    explicit Reader(const std::optional<std::string>& layer) { options_.layer = layer; }

    [[nodiscard]] NamedImage read(const fs::path& file)
    {
        io::LoadedImage loaded = io::read_image(file, options_);
        for (const std::string& warning : loaded.warnings) {
            warnings_.push_back(file.string() + ": " + warning);
        }
        return {.name = file.string(), .image = std::move(loaded.image), .filled = loaded.filled};
    }
    void warn(std::string warning) { warnings_.push_back(std::move(warning)); }
    [[nodiscard]] std::vector<std::string> take_warnings() { return std::move(warnings_); }

private:
    io::ImageOptions options_;
    std::vector<std::string> warnings_;
};

PixelRect common_region(const NamedImage& input, const NamedImage& reference)
{
    const PixelRect region = intersection(input.filled, reference.filled);
    if (region.width() <= 0 || region.height() <= 0) {
        throw Error(ErrorCode::invalid_input,
                    input.name + ": has no pixels in common with the reference " + reference.name);
    }
    return region;
}

}  // namespace

FileComparison compare_files(std::span<const fs::path> files, const fs::path& reference,
                             const std::optional<std::string>& layer,
                             const ComparisonOptions& options)
{
    Reader reader(layer);
    const NamedImage truth = reader.read(reference);
    const auto read_same_size = [&](const fs::path& file) {
        NamedImage read = reader.read(file);
        check_same_size({.name = read.name, .image = read.image},
                        {.name = "the reference " + truth.name, .image = truth.image});
        return read;
    };
    NamedImage input = read_same_size(files[0]);
    const PixelRect region = common_region(input, truth);
    if (region.width() < truth.image.width || region.height() < truth.image.height) {
        reader.warn(input.name + ": compared within " + to_text(region) +
                    " only, where both images have data");
    }
    ComparisonOptions placed = options;
    placed.x0 = region.x0;
    placed.y0 = region.y0;
    Comparison comparison(truth.name, crop(truth.image, region), std::move(placed));
    comparison.add(input.name, crop(input.image, region));
    for (const fs::path& file : files.subspan(1)) {
        input = read_same_size(file);
        if (!(intersection(input.filled, region) == region)) {
            throw Error(ErrorCode::invalid_input, input.name + ": has data within " +
                                                      to_text(input.filled) + ", but " +
                                                      to_text(region) + " is compared");
        }
        comparison.add(input.name, crop(input.image, region));
    }
    return {.report = comparison.report(), .warnings = reader.take_warnings()};
}

}  // namespace bdpt::eval
