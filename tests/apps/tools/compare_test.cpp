#include <bdpt/eval/metric.h>
#include <bdpt/io/write_image.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scratch_folder.h"
#include "subprocess.h"

namespace bdpt::test::compare_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

/// A ramp in all channels, `offset` added to the red.
Image ramp(int width, int height, float offset = 0.0f)
{
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        const float value = static_cast<float>(i % width) / static_cast<float>(width);
        image.pixels.emplace_back(value + offset, value, 0.5f * value);
    }
    return image;
}

std::string write(const ScratchFolder& folder, const std::string& name, const Image& image,
                  io::ExrChannelType type = io::ExrChannelType::single_float)
{
    io::ExrOptions options;
    options.type = type;
    io::write_exr(folder / name, image, options);
    return (folder / name).string();
}

bool all_numbers_finite(const json& value)
{
    // The parser refuses nan and inf, so what is left to check is that nothing was made a text.
    if (value.is_structured()) {
        return std::all_of(value.begin(), value.end(), all_numbers_finite);
    }
    return !value.is_string() || (value != "nan" && value != "inf" && value != "-inf");
}

TEST_CASE("compare prints a table for people")
{
    const ScratchFolder folder;
    const std::string a = write(folder, "a.exr", ramp(40, 20, 0.25f));
    const std::string r = write(folder, "r.exr", ramp(40, 20));
    const Outcome outcome = run({"compare", a, r});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    // 0.25^2 in one channel of three.
    for (const char* text : {"1 image of 40 x 20 pixels", "mse          0.0208333",
                             "rmse          0.144338", "flip_ldr", "red               0.25",
                             "worst tiles of 32 x 32 by relmse", "0,0,32,20", "32,0,40,20"}) {
        CAPTURE(text);
        CHECK(outcome.out.find(text) != std::string::npos);
    }
    CHECK(run({"compare", a, r, "--quiet"}).out.empty());
}

TEST_CASE("compare --json tells programs the same, in stable keys")
{
    const ScratchFolder folder;
    const std::string a = write(folder, "a.exr", ramp(40, 20, 0.25f));
    const std::string r = write(folder, "r.exr", ramp(40, 20));
    const Outcome outcome = run({"compare", a, r, "--json", "--threshold", "mse=0.02"});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 10);
    const json report = json::parse(outcome.out);
    std::vector<std::string> keys;
    for (const auto& [key, value] : report.items()) {
        keys.push_back(key);
    }
    CHECK(keys == std::vector<std::string>{"bias", "image", "images", "metrics", "passed",
                                           "reference", "region", "scale", "seeds", "thresholds",
                                           "tiles"});
    CHECK(all_numbers_finite(report));
    CHECK(report["image"] == a);
    CHECK(report["seeds"] == 1);
    CHECK(report["region"] == json::array({0, 0, 40, 20}));
    CHECK(report["metrics"].size() == eval::all_metrics.size());
    CHECK(report["metrics"]["mse"]["mean"].get<double>() == Approx(0.0625 / 3));
    CHECK(report["metrics"]["mse"]["standard_deviation"].is_null());
    CHECK(report["bias"]["from"] == "blocks");
    CHECK(report["bias"]["red"]["value"].get<double>() == Approx(0.25));
    CHECK(report["bias"]["green"]["value"] == 0.0);
    CHECK(report["tiles"]["worst"][0]["rect"] == json::array({0, 0, 32, 20}));
    CHECK(report["thresholds"][0]["passed"] == false);
    CHECK(report["passed"] == false);
    CHECK(report["scale"]["epsilon"] == 0.01);
    CHECK(report["images"][0]["file"] == a);
}

TEST_CASE("thresholds decide the exit code")
{
    const ScratchFolder folder;
    const std::string a = write(folder, "a.exr", ramp(40, 20, 0.25f));
    const std::string r = write(folder, "r.exr", ramp(40, 20));
    const auto exit_code = [&](const Words& more) {
        Words words{"compare", a, r, "--metrics", "mse"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).exit_code;
    };
    CHECK(exit_code({"--threshold", "mse=0.021"}) == 0);
    CHECK(exit_code({"--threshold", "mse=0.0208"}) == 10);
    CHECK(exit_code({"--threshold", "mse=0.021", "--threshold", "bias=0.2"}) == 10);
    // A metric that is not in the list is computed all the same.
    CHECK(exit_code({"--threshold", "rmse=0.1"}) == 10);
    CHECK(exit_code({"--threshold", "psnr=100"}) == 10);
    CHECK(exit_code({"--threshold", "psnr=1"}) == 0);
    CHECK(exit_code({"--threshold", "p=0.1"}) == 2);
    CHECK(run({"compare", r, r, "--threshold", "psnr=1000", "--threshold", "flip=0"}).exit_code ==
          0);
}

TEST_CASE("a folder of seeds is compared as one")
{
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "seeds");
    const std::string r = write(folder, "seeds/reference.exr", ramp(40, 20));
    for (int seed = 0; seed < 4; ++seed) {
        // Biased by 0.1, with a spread of +-0.001.
        const float offset = 0.1f + (seed % 2 == 0 ? 0.001f : -0.001f);
        write(folder, "seeds/s" + std::to_string(seed) + ".exr", ramp(40, 20, offset));
    }
    const std::string seeds = (folder / "seeds").string();
    const Outcome outcome = run({"compare", seeds, r, "--json", "--threshold", "p=1e-3"});
    CAPTURE(outcome.out, outcome.err);
    CHECK(outcome.exit_code == 10);
    const json report = json::parse(outcome.out);
    CHECK(report["seeds"] == 4);
    CHECK(report["images"].size() == 4);
    CHECK(report["bias"]["from"] == "seeds");
    CHECK(report["bias"]["red"]["value"].get<double>() == Approx(0.1).epsilon(1e-4));
    // The spread of +-0.001 has variance 4e-6 / 3, the mean of four a third of 1e-6.
    CHECK(report["bias"]["red"]["standard_error"].get<double>() ==
          Approx(0.001 / std::sqrt(3.0)).epsilon(1e-2));
    CHECK(report["tiles"]["biased"][0]["channel"] == "red");
    CHECK(report["tiles"]["biased"][0]["p"].get<double>() < 1e-3);
    CHECK(report["metrics"]["rmse"]["standard_deviation"].is_number());
    CHECK(run({"compare", seeds, r}).out.find("4 images of 40 x 20 pixels") != std::string::npos);
}

TEST_CASE("the error image is drawn on the scale that was asked for")
{
    const ScratchFolder folder;
    const std::string a = write(folder, "a.exr", ramp(200, 20, 0.25f));
    const std::string r = write(folder, "r.exr", ramp(200, 20));
    const std::string file = (folder / "error.png").string();
    const auto color = [&](const std::string& scale) {
        const Outcome outcome = run({"compare", a, r, "--error-image", file, "--error-metric",
                                     "mse", "--scale", scale, "--quiet"});
        CAPTURE(outcome.err);
        CHECK(outcome.exit_code == 0);
        const PngFile png = read_png(file);
        CHECK(png.width == 200);
        CHECK(png.height == 20 + 38);
        return std::vector<int>(png.rgb.begin(), png.rgb.begin() + 3);
    };
    const std::vector<int> dark = color("1");
    const std::vector<int> light = color("0.03");
    CHECK(dark[1] < 20);
    CHECK(light[0] > 200);
    CHECK(color("0.03") == light);
    CHECK(folder.names() == std::set<std::string>{"a.exr", "error.png", "r.exr"});
}

TEST_CASE("layers and halves are compared")
{
    const ScratchFolder folder;
    const auto write_layers = [&folder](const std::string& name, float albedo) {
        const Image image = ramp(8, 8);
        const std::vector<Layer> layers{{.name = "albedo",
                                         .channels = "RGB",
                                         .width = 8,
                                         .height = 8,
                                         .values = std::vector<float>(192, albedo)},
                                        {.name = "depth",
                                         .channels = "Z",
                                         .width = 8,
                                         .height = 8,
                                         .values = std::vector<float>(64, 2.0f * albedo)},
                                        {.name = "odd",
                                         .channels = "UV",
                                         .width = 8,
                                         .height = 8,
                                         .values = std::vector<float>(128, 0.0f)}};
        io::write_exr(folder / name, image, layers, {});
        return (folder / name).string();
    };
    const std::string a = write_layers("a.exr", 0.5f);
    const std::string b = write_layers("b.exr", 0.75f);
    const auto mse = [](const Words& words) {
        const Outcome outcome = run(words);
        CAPTURE(outcome.err);
        REQUIRE(outcome.exit_code == 0);
        return json::parse(outcome.out)["metrics"]["mse"]["mean"].get<double>();
    };
    CHECK(mse({"compare", a, b, "--json"}) == 0.0);
    CHECK(mse({"compare", a, b, "--json", "--layer", "albedo"}) == 0.0625);
    CHECK(mse({"compare", a, b, "--json", "--layer", "depth"}) == 0.25);
    const Outcome missing = run({"compare", a, b, "--layer", "normal"});
    CHECK(missing.exit_code == 3);
    CHECK(missing.err.find(
              "b.exr: no layer \"normal\"; the file has \"B\", \"G\", \"R\", \"albedo\", "
              "\"depth\", \"odd\"") != std::string::npos);
    CHECK(run({"compare", a, b, "--layer", "odd"}).exit_code == 5);

    const std::string half = write(folder, "half.exr", ramp(8, 8), io::ExrChannelType::half_float);
    CHECK(mse({"compare", half, a, "--json"}) < 1e-7);
}

/// Runs what must fail with `code`, in one line that contains `text`.
void check_error(const Words& words, int code, const std::string& text)
{
    const Outcome outcome = run(words);
    CAPTURE(words, outcome.err, outcome.out);
    CHECK(outcome.exit_code == code);
    CHECK(outcome.out.empty());
    CHECK(outcome.err.starts_with("bdpt: error: "));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
    CHECK(outcome.err.find(text) != std::string::npos);
}

TEST_CASE("bad input of compare gives one line and the documented exit code")
{
    const ScratchFolder folder;
    const std::string a = write(folder, "a.exr", ramp(8, 8));
    const std::string small = write(folder, "small.exr", ramp(8, 7));
    Image broken = ramp(8, 8);
    broken.pixels[8 * 3 + 2].b = std::numeric_limits<float>::quiet_NaN();
    const std::string nan = write(folder, "nan.exr", broken);
    broken.pixels[8 * 3 + 2].b = std::numeric_limits<float>::infinity();
    const std::string infinite = write(folder, "inf.exr", broken);
    const std::string text = (folder / "text.exr").string();
    write_text(text, "not an image");
    const std::string cut = (folder / "cut.exr").string();
    write_text(cut, read_text(a).substr(0, 500));
    const std::string empty = (folder / "empty").string();
    std::filesystem::create_directory(empty);
    const std::string black = write(folder, "black.exr", {8, 8, std::vector<Rgb>(64, Rgb(0.0f))});

    check_error({"compare", a}, 2, "reference is required");
    check_error({"compare", small, a}, 4, "small.exr: has 8 x 7 pixels, but the reference");
    check_error({"compare", nan, a}, 4, "nan.exr: pixel (2, 3) has nan in channel blue");
    check_error({"compare", a, infinite}, 4, "inf.exr: pixel (2, 3) has inf in channel blue");
    check_error({"compare", (folder / "no.exr").string(), a}, 3, "no.exr: no such file");
    check_error({"compare", a, (folder / "no.exr").string()}, 3, "no.exr: no such file");
    check_error({"compare", text, a}, 5,
                "text.exr: neither OpenEXR, Radiance HDR, PNG, JPEG nor WebP");
    check_error({"compare", cut, a}, 4, "cut.exr: OpenEXR");
    check_error({"compare", empty, a}, 3, "the folder has no .exr or .hdr file");
    check_error({"compare", a, empty}, 2, "the reference is a folder");
    check_error({"compare", a, black, "--relative"}, 4, "the reference's mean is 0");
    check_error({"compare", a, a, "--metrics", "relmse,frob"}, 2, "--metrics \"relmse,frob\"");
    check_error({"compare", a, a, "--metrics", ""}, 2, "--metrics");
    check_error({"compare", a, a, "--threshold", "frob=1"}, 2, "--threshold \"frob=1\"");
    check_error({"compare", a, a, "--error-metric", "psnr"}, 2, "--error-metric \"psnr\"");
    check_error({"compare", a, a, "--scale", "0"}, 2, "--scale");
    check_error({"compare", a, a, "--epsilon", "-1"}, 2, "--epsilon");
    check_error({"compare", a, a, "--ppd", "0"}, 2, "--ppd");
    check_error({"compare", a, a, "--tile", "0"}, 2, "--tile");
    check_error({"compare", a, a, "--flip-exposures", "1,0,2"}, 2, "--flip-exposures");
    check_error({"compare", a, a, "--exposure", "nan"}, 2, "--exposure");
    check_error({"compare", a, a, "--frob"}, 2, "see \"bdpt compare --help\"");
    check_error({"compare", a, a, "--error-image", (folder / "e.exr").string()}, 2,
                "expected a file name that ends in .png");
    check_error({"compare", a, a, "--error-image", (folder / "no/e.png").string()}, 6,
                "cannot write");
}

TEST_CASE("an error image that cannot be written does not take the report along")
{
    const ScratchFolder folder;
    const std::string a = write(folder, "a.exr", ramp(200, 100, 0.1f));
    const std::string r = write(folder, "r.exr", ramp(200, 100));
    const auto before = folder.names();
    const Outcome outcome = run(Launch{
        .arguments = {"compare", a, r, "--json", "--error-image", (folder / "e.png").string()},
        .file_size = 500});
    CAPTURE(outcome.err);
    CHECK(outcome.exit_code == 6);
    CHECK(outcome.err.find("e.png") != std::string::npos);
    // The report is whole; the error is an event after it.
    CHECK(outcome.out.find("\"metrics\"") != std::string::npos);
    CHECK(folder.names() == before);
}

}  // namespace
}  // namespace bdpt::test::compare_test
