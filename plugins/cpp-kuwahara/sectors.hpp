// The mean and the variance of each of eight sectors of an ellipse, and what they give together.
#ifndef KUWAHARA_SECTORS_HPP
#define KUWAHARA_SECTORS_HPP

#include <algorithm>
#include <array>
#include <cmath>

#include "picture.hpp"

namespace kuwahara {

constexpr std::size_t sector_count = 8;

using lanes = std::array<float, sector_count>;

// Cosine and sine of the middle of each sector.
constexpr float half_root = 0.70710678f;
constexpr lanes middle_x = {1, half_root, 0, -half_root, -1, -half_root, 0, half_root};
constexpr lanes middle_y = {0, half_root, 1, half_root, 0, -half_root, -1, -half_root};

// Of the polynomial weights ((x + overlap) - bend y²)², in the unit disc with the sector's middle
// along x: how far sectors reach over the centre, and how narrow they are. They meet at 3/8 π.
constexpr float overlap = 1.0f / 3.0f;
constexpr float bend = (overlap + 0.38268343f) / 0.85355339f;

// An ellipse around the origin: its half axes, and the direction of the longer.
struct ellipse {
    float along, across;
    float x, y;
};

// The weights of the sectors at a place of the unit disc. They are one together, times a window
// that falls to 0 at the edge: (1 - d²)² in the place of a Gaussian, because it ends there.
inline void weigh(float x, float y, float distance, lanes &weights)
{
    float sum = 0;
    for (std::size_t k = 0; k < sector_count; k++) {
        const float ahead = x * middle_x[k] + y * middle_y[k];
        const float aside = y * middle_x[k] - x * middle_y[k];
        const float root = ahead + overlap - bend * aside * aside;
        weights[k] = root > 0 ? root * root : 0;
    }
    for (std::size_t k = 0; k < sector_count; k++) {
        sum += weights[k];
    }
    const float window = (1 - distance) * (1 - distance) / sum;
    for (std::size_t k = 0; k < sector_count; k++) {
        weights[k] *= window;
    }
}

// Sums over the pixels of an ellipse, of the differences from its centre: so what is the same
// everywhere stays exactly that, and variances do not cancel.
template <std::size_t Channels> struct sectors {
    lanes weight = {};
    lanes square = {};
    std::array<lanes, Channels> sum = {};

    void add(const float *pixel, const float *centre, const lanes &weights)
    {
        float squares = 0;
        for (std::size_t c = 0; c < Channels; c++) {
            const float difference = pixel[c] - centre[c];
            squares += difference * difference;
            for (std::size_t k = 0; k < sector_count; k++) {
                sum[c][k] += weights[k] * difference;
            }
        }
        for (std::size_t k = 0; k < sector_count; k++) {
            weight[k] += weights[k];
            square[k] += weights[k] * squares;
        }
    }

    // The means of the sectors, each weighted by how even it is: by 1 / (1 + (255 σ²)^(q/2)).
    void give(const ptlp_math &math, double sharpness, const float *centre, float *out) const
    {
        double total = 0;
        std::array<double, Channels> mixed = {};
        for (std::size_t k = 0; k < sector_count; k++) {
            if (!(weight[k] > 0)) {
                continue;
            }
            std::array<double, Channels> mean = {};
            double variance = static_cast<double>(square[k]) / static_cast<double>(weight[k]);
            for (std::size_t c = 0; c < Channels; c++) {
                mean[c] = static_cast<double>(sum[c][k]) / static_cast<double>(weight[k]);
                variance -= mean[c] * mean[c];
            }
            const double even = 1 / (1 + math.pow(255 * std::max(variance, 0.0), sharpness / 2));
            total += even;
            for (std::size_t c = 0; c < Channels; c++) {
                mixed[c] += even * mean[c];
            }
        }
        for (std::size_t c = 0; c < Channels; c++) {
            const double moved = total > 0 ? mixed[c] / total : 0;
            out[c] = static_cast<float>(static_cast<double>(centre[c]) + moved);
        }
    }
};

// The places of an ellipse that are read: those of a lattice of `stride` pixels.
class lattice {
public:
    // `reach` is the longest half axis that any ellipse may have, in pixels.
    lattice(const picture &from, std::uint32_t stride, double reach)
        : from_(&from), stride_(stride),
          margin_(static_cast<std::int64_t>(reach) + std::int64_t{stride} + 1)
    {
        const auto width = static_cast<std::int64_t>(from.width);
        columns_.reserve(static_cast<std::size_t>(width + 2 * margin_));
        for (std::int64_t x = -margin_; x < width + margin_; x++) {
            columns_.push_back(pp::wrap(x, from.width) * from.channels);
        }
    }

    template <std::size_t Channels>
    sectors<Channels> sums(std::uint32_t x, std::uint32_t y, const ellipse &around) const
    {
        sectors<Channels> made;
        const float stride = static_cast<float>(stride_);
        const float ax = around.x / around.along, ay = around.y / around.along;
        const float bx = -around.y / around.across, by = around.x / around.across;
        // How far the ellipse reaches along x and y.
        const auto reach = [&](float u, float v) {
            const float along = around.along * u, across = around.across * v;
            return static_cast<std::int64_t>(
                std::sqrt(along * along + across * across) / stride);
        };
        const std::int64_t right = reach(around.x, around.y), down = reach(around.y, around.x);
        const auto step = static_cast<std::int64_t>(stride_);
        const float *centre = from_->row(y) + std::size_t{x} * Channels;
        const std::size_t *column = columns_.data() + margin_ + x;
        for (std::int64_t j = -down; j <= down; j++) {
            const float dy = static_cast<float>(j) * stride;
            const float *row = from_->row(pp::wrap(y + j * step, from_->height));
            for (std::int64_t i = -right; i <= right; i++) {
                const float dx = static_cast<float>(i) * stride;
                const float u = ax * dx + ay * dy, v = bx * dx + by * dy;
                const float distance = u * u + v * v;
                if (distance < 1) {
                    lanes weights;
                    weigh(u, v, distance, weights);
                    made.add(row + column[i * step], centre, weights);
                }
            }
        }
        return made;
    }

private:
    const picture *from_;
    std::uint32_t stride_;
    std::int64_t margin_;
    std::vector<std::size_t> columns_;
};

} // namespace kuwahara

#endif
