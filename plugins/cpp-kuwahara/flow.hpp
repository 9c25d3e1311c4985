// Which way the lines of a picture run, and how clearly: its smoothed structure tensor.
#ifndef KUWAHARA_FLOW_HPP
#define KUWAHARA_FLOW_HPP

#include <algorithm>
#include <cmath>

#include "picture.hpp"

namespace kuwahara {

// The three different numbers of the tensor of each pixel: products of the derivatives along x and
// y, summed over the channels. The derivatives are Sobel's, over steps of `stride` pixels.
inline picture tensor(const picture &from, std::uint32_t stride, const pp::work &work)
{
    picture made(from.width, from.height, 3);
    const auto step = static_cast<std::int64_t>(stride);
    work.parallel(from.height, [&](std::uint32_t y) {
        const float *above = from.row(pp::wrap(y - step, from.height));
        const float *here = from.row(y);
        const float *below = from.row(pp::wrap(y + step, from.height));
        float *to = made.row(y);
        for (std::uint32_t x = 0; x < from.width; x++) {
            const std::size_t left = pp::wrap(x - step, from.width) * from.channels;
            const std::size_t right = pp::wrap(x + step, from.width) * from.channels;
            const std::size_t middle = x * from.channels;
            for (std::size_t c = 0; c < from.channels; c++) {
                const float along_x = (above[right + c] - above[left + c])
                    + 2 * (here[right + c] - here[left + c]) + (below[right + c] - below[left + c]);
                const float along_y = (below[left + c] - above[left + c])
                    + 2 * (below[middle + c] - above[middle + c])
                    + (below[right + c] - above[right + c]);
                to[3 * x] += along_x * along_x;
                to[3 * x + 1] += along_x * along_y;
                to[3 * x + 2] += along_y * along_y;
            }
        }
    });
    return made;
}

// The direction along the lines as a unit vector, and the anisotropy from 0 (none) to 1.
inline void direct(float *pixel)
{
    const double e = pixel[0], f = pixel[1], g = pixel[2];
    const double root = std::sqrt((e - g) * (e - g) + 4 * f * f);
    const double largest = (e + g + root) / 2;
    // Of two vectors along the lines, the one that does not cancel.
    double x = e >= g ? -f : largest - e, y = e >= g ? largest - g : -f;
    const double length = std::sqrt(x * x + y * y);
    const bool is_flat = !(length > 0);
    pixel[0] = is_flat ? 1.0f : static_cast<float>(x / length);
    pixel[1] = is_flat ? 0.0f : static_cast<float>(y / length);
    pixel[2] = e + g > 0 ? static_cast<float>(std::min(root / (e + g), 1.0)) : 0.0f;
}

// Direction and anisotropy of each pixel. Three means of squares come close to a Gaussian (W. M.
// Wells, "Efficient Synthesis of Gaussian Filters by Cascaded Uniform Filters", 1986); `sigma`, its
// standard deviation, counts pixels.
inline picture flow(
    const picture &from, std::uint32_t stride, double sigma, const pp::work &work)
{
    picture made = tensor(from, stride, work);
    const double side = std::sqrt(4 * sigma * sigma + 1);
    const auto reach = static_cast<std::uint32_t>((side - 1) / 2 + 0.5);
    for (int pass = 0; reach > 0 && pass < 3; pass++) {
        made = mean_of_squares(made, reach, work);
    }
    work.parallel(made.height, [&](std::uint32_t y) {
        float *row = made.row(y);
        for (std::size_t x = 0; x < made.width; x++) {
            direct(row + 3 * x);
        }
    });
    return made;
}

} // namespace kuwahara

#endif
