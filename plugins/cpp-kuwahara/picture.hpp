// Pictures whose channels lie side by side, on a torus, and their means over squares.
#ifndef KUWAHARA_PICTURE_HPP
#define KUWAHARA_PICTURE_HPP

#include <cstddef>
#include <cstdint>
#include <vector>

#include <ptlib/ptlib_plugin.hpp>

namespace kuwahara {

namespace pp = ptlib::plugin;

// Numbers of a pixel side by side, rows from the top.
struct picture {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::size_t channels = 0;
    std::vector<float> numbers;

    picture() = default;
    picture(std::uint32_t across, std::uint32_t down, std::size_t each)
        : width(across), height(down), channels(each),
          numbers(std::size_t{across} * down * each)
    {
    }

    float *row(std::uint32_t y) { return numbers.data() + std::size_t{y} * width * channels; }
    const float *row(std::uint32_t y) const
    {
        return numbers.data() + std::size_t{y} * width * channels;
    }
};

// An image, its colours multiplied by alpha, so that what cannot be seen does not bleed.
inline picture premultiplied(const pp::image &image, const pp::work &work)
{
    picture made(image.width(), image.height(), image.channels());
    work.parallel(made.height, [&](std::uint32_t y) {
        float *to = made.row(y);
        for (std::uint32_t channel = 0; channel < image.channels(); channel++) {
            const auto from = image.row(channel, y);
            for (std::size_t x = 0; x < from.size(); x++) {
                to[x * made.channels + channel] = from[x];
            }
        }
        if (image.has_alpha()) {
            for (std::size_t x = 0; x < made.width; x++) {
                for (std::size_t channel = 0; channel < 3; channel++) {
                    to[4 * x + channel] *= to[4 * x + 3];
                }
            }
        }
    });
    return made;
}

// The mean of the square of 2 reach + 1 pixels around each pixel, beyond the edges from the other
// side. Columns are summed anew for each row and then slid along, so the order of all sums is the
// same for every number of threads; sums of equal numbers are exact.
inline picture mean_of_squares(const picture &from, std::uint32_t reach, const pp::work &work)
{
    picture made(from.width, from.height, from.channels);
    const auto radius = static_cast<std::int64_t>(reach);
    const double side = 2.0 * reach + 1.0;
    const std::size_t channels = from.channels, count = from.width * channels;
    work.parallel(from.height, [&](std::uint32_t y) {
        std::vector<double> columns(count);
        for (std::int64_t j = -radius; j <= radius; j++) {
            const float *row = from.row(pp::wrap(y + j, from.height));
            for (std::size_t i = 0; i < count; i++) {
                columns[i] += static_cast<double>(row[i]);
            }
        }
        float *to = made.row(y);
        for (std::size_t channel = 0; channel < channels; channel++) {
            const auto column = [&](std::int64_t x) {
                return columns[pp::wrap(x, from.width) * channels + channel];
            };
            double sum = 0;
            for (std::int64_t x = -radius; x <= radius; x++) {
                sum += column(x);
            }
            for (std::int64_t x = 0; x < from.width; x++) {
                to[static_cast<std::size_t>(x) * channels + channel] =
                    static_cast<float>(sum / (side * side));
                sum += column(x + radius + 1) - column(x - radius);
            }
        }
    });
    return made;
}

} // namespace kuwahara

#endif
