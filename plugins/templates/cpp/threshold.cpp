// A plug-in for ptlib in C++: one block that makes an image black and white.
//
// Copy this folder, and change the vendor, the block's description, its parameters, and what it
// computes. ptlib_plugin.hpp says what else there is, the rules are at the top of ptlib_plugin.h.
#include <ptlib/ptlib_plugin.hpp>

namespace {

namespace pp = ptlib::plugin;

class threshold {
public:
    static constexpr auto about =
        pp::about("my-vendor.threshold", "Black where an image is below a level, white elsewhere.")
            .category("adjust");

    static constexpr pp::input_port inputs[] = {
        pp::input("image", pp::kind::image).doc("What is divided.")};
    static constexpr pp::output_port outputs[] = {pp::output("image", pp::planes::as_input(0))};

    // The places of the parameters.
    enum : std::size_t { level };
    static constexpr pp::param params[] = {
        pp::float_param("level", 0.5).hard(0, 1).doc("Values below it become black, others white.")};

    // Once in a computation.
    void prepare(const pp::setup &setup) { level_ = setup.number_f(level); }

    // For one row after the other, on several threads.
    void row(const pp::row &row) const
    {
        for (std::uint32_t channel = 0; channel < row.channels(); channel++) {
            const auto from = row.in(0, channel);
            const auto to = row.out(channel);
            for (std::size_t x = 0; x < to.size(); x++) {
                to[x] = from[x] >= level_ ? 1.0f : 0.0f;
            }
        }
    }

private:
    float level_ = 0;
};

} // namespace

constexpr ptlp_entry ptl_plugin_entry_v1 =
    pp::entry<threshold>("my-vendor.threshold", "Threshold").vendor("My vendor").license("MIT");
