// A plug-in for ptlib in C++: the anisotropic Kuwahara filter, which paints a picture with strokes
// that follow its lines.
//
// Around each pixel lies an ellipse along the lines of the picture (flow.hpp), divided into eight
// sectors; the most even sectors give the pixel (sectors.hpp). So what is inside of a shape becomes
// flat and its edge stays sharp. J. E. Kyprianidis, H. Kang, J. Döllner, "Image and Video
// Abstraction by Anisotropic Kuwahara Filtering", Computer Graphics Forum 28(7), 2009; the weights
// of the sectors are those of J. E. Kyprianidis, A. Semmo, H. Kang, J. Döllner, "Anisotropic
// Kuwahara Filtering with Polynomial Weighting Functions", EG UK TPCG, 2010.
//
// Lengths are parts of the width. Of a large ellipse only every second, third, … pixel is read, and
// what lies between is in the mean that was taken before: more pixels cost no more than the picture
// has.
#include <optional>

#include "flow.hpp"
#include "sectors.hpp"

namespace {

namespace pp = ptlib::plugin;

using kuwahara::ellipse;
using kuwahara::lattice;
using kuwahara::picture;

// Steps from the centre of a round window to its edge; above it, the steps get longer.
constexpr double most_steps = 10;

// Pixels between two questions whether to stop: about a millisecond of work.
constexpr std::size_t pixels_of_a_check = 32;

class anisotropic_kuwahara {
public:
    static constexpr auto about =
        pp::about(
            "kuwahara.anisotropic",
            "Paints an image with strokes along its lines: flat inside, sharp at edges.")
            .name("anisotropic Kuwahara filter")
            .category("filter")
            .shape(pp::shape::gather);

    static constexpr pp::input_port inputs[] = {
        pp::input("image", pp::kind::image).anywhere().doc("What is painted.")};
    static constexpr pp::output_port outputs[] = {pp::output("image", pp::planes::as_input(0))};

    enum : std::size_t { radius, sharpness, eccentricity, smoothing };
    static constexpr pp::param params[] = {
        pp::float_param("radius", 0.8)
            .hard(0, 10)
            .soft(0, 3)
            .unit("% of the width")
            .doc("How large strokes are, where the image has no direction; 0 changes nothing."),
        pp::float_param("sharpness", 8)
            .hard(0, 64)
            .soft(1, 16)
            .doc("How much the most even part of a stroke's surroundings counts: 0 is a blur, and "
                 "large numbers give hard edges."),
        pp::float_param("eccentricity", 1)
            .hard(0, 3)
            .soft(0, 2)
            .doc("How long strokes get where the image has a clear direction: 0 leaves them round, "
                 "1 makes them up to four times as long as wide."),
        pp::float_param("smoothing", 0.4)
            .hard(0, 5)
            .soft(0, 2)
            .unit("% of the width")
            .doc("Over how much the direction is averaged: more makes strokes flow more calmly.")};

    void prepare(const pp::setup &setup)
    {
        const auto image = setup.image(0);
        if (!image) {
            throw pp::block_error::unconnected("needs an image at input \"image\"");
        }
        const double width = image->width();
        radius_ = setup.number(radius) / 100 * width;
        if (radius_ < 1) {
            return; // No neighbour is inside.
        }
        sharpness_ = setup.number(sharpness);
        eccentricity_ = setup.number(eccentricity);
        math_ = &pp::math::functions();
        const auto stride = static_cast<std::uint32_t>(std::ceil(radius_ / most_steps));
        source_ = kuwahara::premultiplied(*image, setup);
        if (stride > 1) {
            source_ = kuwahara::mean_of_squares(source_, stride / 2, setup);
        }
        const double sigma = setup.number(smoothing) / 100 * width;
        flow_ = kuwahara::flow(source_, stride, sigma, setup);
        lattice_.emplace(source_, stride, radius_ * (1 + eccentricity_));
    }

    void row(const pp::row &row) const
    {
        if (!lattice_) {
            const pp::image image = row.call().image(0);
            for (std::uint32_t channel = 0; channel < row.channels(); channel++) {
                const auto from = image.row(channel, row.y());
                std::copy_n(from.begin() + row.x(), row.width(), row.out(channel).begin());
            }
            return;
        }
        switch (source_.channels) {
        case 1: return paint<1>(row);
        case 3: return paint<3>(row);
        default: return paint<4>(row);
        }
    }

    // The picture and the flow, each once more while they are made.
    static std::uint64_t memory(const pp::setup &setup)
    {
        const std::uint64_t pixels = std::uint64_t{setup.width()} * setup.height();
        return pixels * (2 * 4 + 2 * 3) * sizeof(float);
    }

private:
    // The ellipse of a pixel. Its axes are those of the paper: the radius times and by
    // (1 + anisotropy / α), with 1 / α as the eccentricity.
    ellipse around(const float *flow) const
    {
        const double stretch = 1 + eccentricity_ * static_cast<double>(flow[2]);
        return {static_cast<float>(radius_ * stretch), static_cast<float>(radius_ / stretch),
                flow[0], flow[1]};
    }

    template <std::size_t Channels> void paint(const pp::row &row) const
    {
        std::array<float *, Channels> out;
        for (std::size_t c = 0; c < Channels; c++) {
            out[c] = row.out(static_cast<std::uint32_t>(c)).data();
        }
        const float *flow = flow_.row(row.y()) + std::size_t{row.x()} * 3;
        const float *centre = source_.row(row.y()) + std::size_t{row.x()} * Channels;
        for (std::uint32_t x = 0; x < row.width(); x++, flow += 3, centre += Channels) {
            if (x % pixels_of_a_check == 0) {
                row.call().check();
            }
            const auto sums = lattice_->sums<Channels>(row.x() + x, row.y(), around(flow));
            std::array<float, Channels> pixel;
            sums.give(*math_, sharpness_, centre, pixel.data());
            if constexpr (Channels == 4) {
                // Colours are stored as if nothing were transparent.
                for (std::size_t c = 0; c < 3; c++) {
                    pixel[c] = pixel[3] > 0 ? std::min(pixel[c] / pixel[3], 1.0f) : 0.0f;
                }
            }
            for (std::size_t c = 0; c < Channels; c++) {
                out[c][x] = pixel[c];
            }
        }
    }

    double radius_ = 0;
    double sharpness_ = 0;
    double eccentricity_ = 0;
    const ptlp_math *math_ = nullptr;
    picture source_;
    picture flow_;
    std::optional<lattice> lattice_;
};

} // namespace

constexpr ptlp_entry ptl_plugin_entry_v1 =
    pp::entry<anisotropic_kuwahara>("kuwahara", "Kuwahara")
        .vendor("The ptlib project")
        .license("MIT OR Apache-2.0");
