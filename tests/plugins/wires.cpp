// A plug-in in C++ whose blocks take and make everything that a wire carries.
#include <cstdint>
#include <string>

#include <ptlib/ptlib_plugin.hpp>

namespace {

namespace pp = ptlib::plugin;

// The centre of each triangle, a strand upwards from each centre, and the mesh once more: its
// corners shared, its triangles turned round.
class shapes {
public:
    static constexpr auto about =
        pp::about("ptlib-wires.shapes", "Makes shapes of a mesh.").shape(pp::shape::whole);
    static constexpr pp::input_port inputs[] = {pp::input("mesh", pp::kind::mesh)};
    static constexpr pp::output_port outputs[] = {
        pp::output("points", pp::kind::points), pp::output("strands", pp::kind::strands),
        pp::output("mesh", pp::kind::mesh), pp::output("same mesh", pp::kind::mesh)};

    void compute(pp::call &call) const
    {
        const pp::mesh mesh = call.mesh(0);
        const auto corners = mesh.streams().positions();
        const std::uint32_t count = mesh.triangle_count();
        const auto centre = [&](std::size_t triangle, std::size_t axis) {
            const std::uint32_t *three = mesh.indices().data() + 3 * triangle;
            return (corners[three[0]][axis] + corners[three[1]][axis] + corners[three[2]][axis])
                / 3.0f;
        };

        const pp::new_points points(call, 0, count, {pp::new_stream("position", 3)});
        const pp::new_strands strands(
            call, 1, {count, 2 * count}, {pp::new_stream("position", 3)},
            {pp::new_stream("id", 2, PTL_STREAM_U32)});
        const auto roots = points.stream(0), along = strands.point_stream(0);
        const auto ids = strands.strand_stream<std::uint32_t>(0);
        for (std::uint32_t i = 0; i < count; i++) {
            for (std::size_t axis = 0; axis < 3; axis++) {
                roots[i][axis] = along[2 * i][axis] = along[2 * i + 1][axis] = centre(i, axis);
            }
            along[2 * i + 1][2] += 1;
            strands.first_point()[i] = 2 * i;
            ids[i][0] = i;
        }
        strands.first_point()[count] = 2 * count;
        points.finish();
        strands.finish();

        const pp::new_mesh turned(
            call, 2, mesh.vertex_count(), count, {pp::shared_stream(corners)});
        const auto to = turned.indices();
        for (std::size_t i = 0; i < to.size(); i++) {
            to[i] = mesh.indices()[to.size() - 1 - i];
        }
        turned.finish();
        call.pass(3, 0);
    }
};

// A text and a colour transition, from those at the inputs and from scratch memory.
class words {
public:
    static constexpr auto about =
        pp::about("ptlib-wires.words", "Makes a text and a colour transition.")
            .shape(pp::shape::whole);
    static constexpr pp::input_port inputs[] = {
        pp::input("text", pp::kind::text), pp::input("colours", pp::kind::gradient)};
    static constexpr pp::output_port outputs[] = {
        pp::output("text", pp::kind::text), pp::output("colours", pp::kind::gradient)};

    void compute(pp::call &call) const
    {
        call.report(0.5);
        call.log(pp::level::debug, "words");
        call.set_text(0, std::string(call.text(0)) + "!");
        auto stops = call.scratch<ptl_gradient_stop>(3);
        for (std::size_t i = 0; i < stops.size(); i++) {
            const float position = 0.5f * static_cast<float>(i);
            const auto color = call.gradient(1).at(position);
            stops[i] = {position, {color[2], color[1], color[0]}};
        }
        call.set_gradient(1, {stops.data(), stops.size()});
    }
};

// Numbers of the host, and all kinds of parameters.
class numbers {
public:
    static constexpr auto about = pp::about("ptlib-wires.numbers", "Shows numbers of the host.")
                                      .name("Numbers")
                                      .category("testing")
                                      .version(3)
                                      .uses_seed()
                                      .threads(pp::threads::instance)
                                      .tiling_exception("it is a test")
                                      .in_pixels("length");
    static constexpr pp::output_port outputs[] = {
        pp::output("image", pp::planes::colour()).free_range().doc("Numbers.")};
    enum : std::size_t { length, factor, is_bright, words };
    static constexpr pp::param params[] = {
        pp::int_param("length", 5).hard(0, 100).soft(0, 50).unit("px").doc("How long."),
        pp::float_param("factor", 0.25).hard(-1, 1).doc("A factor."),
        pp::flag_param("bright", true).doc("Whether."),
        pp::text_param("words", "two words").doc("Any.")};

    void prepare(const pp::setup &setup)
    {
        seed_ = setup.seed();
        sum_ = setup.integer(length) + setup.number(factor) + (setup.flag(is_bright) ? 100 : 0)
            + static_cast<double>(std::string(setup.text(words)).size());
    }

    void row(const pp::row &row)
    {
        rows_++;
        for (std::uint32_t x = 0; x < row.width(); x++) {
            row.out(0)[x] = static_cast<float>(sum_);
            row.out(1)[x] = static_cast<float>(pp::math::sin(row.x() + x) + pp::math::pow(2, 0.5));
            row.out(2)[x] = pp::noise::uniform(seed_, row.x() + x, row.y());
        }
    }

private:
    std::uint64_t seed_ = 0;
    double sum_ = 0;
    std::uint32_t rows_ = 0; // Changed without a lock: one thread is inside.
};

} // namespace

constexpr ptlp_entry ptl_plugin_entry_v1 =
    pp::entry<shapes, words, numbers>("ptlib-wires", "Wires")
        .vendor("The tests of ptlib")
        .version("1.2.3")
        .license("MIT OR Apache-2.0");
