#include <bdpt/eval/drawing.h>

#include <algorithm>

namespace bdpt::eval {

Image shrunk(const Image& image, int factor)
{
    Image result{(image.width + factor - 1) / factor, (image.height + factor - 1) / factor, {}};
    for (int y0 = 0; y0 < image.height; y0 += factor) {
        for (int x0 = 0; x0 < image.width; x0 += factor) {
            const int x1 = std::min(x0 + factor, image.width);
            const int y1 = std::min(y0 + factor, image.height);
            Rgb sum(0.0f);
            for (int y = y0; y < y1; ++y) {
                for (int x = x0; x < x1; ++x) {
                    sum += image.at(x, y);
                }
            }
            result.pixels.push_back(sum / static_cast<float>((x1 - x0) * (y1 - y0)));
        }
    }
    return result;
}

}  // namespace bdpt::eval
