// The C++ wrapper: owners, exceptions both ways, callbacks that throw.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include <ptlib/ptlib.hpp>

#define CHECK(condition) \
    do { \
        if (!(condition)) { \
            std::fprintf(stderr, "%s:%d: %s\n", __FILE__, __LINE__, #condition); \
            std::exit(1); \
        } \
    } while (0)

template <typename T> constexpr bool moves_only = std::is_nothrow_move_constructible_v<T> &&
                                                  !std::is_copy_constructible_v<T>;
static_assert(moves_only<ptlib::engine> && moves_only<ptlib::graph> && moves_only<ptlib::image>);
static_assert(moves_only<ptlib::value> && moves_only<ptlib::job> && moves_only<ptlib::cancel>);

// What a callback throws, to be known again.
struct enough {
    int number;
};

template <typename Exception, typename Work> static Exception thrown(Work work)
{
    try {
        work();
    } catch (const Exception &exception) {
        return exception;
    }
    std::fprintf(stderr, "nothing was thrown\n");
    std::exit(1);
}

static void errors(ptlib::graph &graph, ptl_block block)
{
    const auto range = thrown<ptlib::error>([&] { graph.set_int(block, "count", 9999); });
    CHECK(range.status() == PTL_E_OUT_OF_RANGE && range.block() == block);
    CHECK(range.param() == "count" && std::strstr(range.what(), "9999") != nullptr);
    CHECK(range.faults().size() == 1 && range.faults()[0].param == "count");
    const auto missing = thrown<ptlib::error>([&] { graph.add("no such type"); });
    CHECK(missing.status() == PTL_E_NOT_FOUND && missing.block() == 0 && missing.param().empty());
    ptl_block stale = graph.add("end");
    graph.remove(stale);
    CHECK(thrown<ptlib::error>([&] { graph.validate(stale); }).status() == PTL_E_STALE_HANDLE);
}

// Two points, one at `x`.
static void values(ptlib::graph &graph)
{
    float places[2][3] = {{0, 0, 0}, {7, 0, 0}};
    ptl_stream stream = {};
    stream.struct_size = sizeof stream;
    stream.type = PTL_STREAM_F32;
    stream.components = 3;
    stream.id = "position";
    stream.data = places;
    stream.stride = sizeof *places;
    const ptl_stream *const streams[] = {&stream};
    ptl_points_data points = {};
    points.struct_size = sizeof points;
    points.point_count = 2;
    points.stream_count = 1;
    points.streams = streams;

    int released = 0;
    {
        const auto lent = ptlib::value::borrow(points, [&] { released++; });
        CHECK(lent.kind() == PTL_KIND_POINTS && lent.points().bounds_max[0] == 7);
        CHECK(lent.retain().points().streams[0]->data == places && released == 0);
        CHECK(thrown<ptlib::error>([&] { lent.mesh(); }).status() == PTL_E_TYPE_MISMATCH);
        const ptl_block input = graph.add("points input");
        CHECK(graph.find_input("points") == input && graph.find_input("other") == 0);
        graph.set_input(input, lent);
        CHECK(graph.compute_value(input).points().streams[0]->data == places);
        graph.clear_input(input);
        CHECK(thrown<ptlib::error>([&] { graph.compute_value(input); }).status() ==
              PTL_E_UNCONNECTED);
        graph.remove(input);
    }
    CHECK(released == 1);
    points.point_count = 3000000000u;
    thrown<ptlib::error>([&] { ptlib::value::borrow(points, [&] { released++; }); });
    CHECK(released == 2);

    CHECK(ptlib::value("D(10)").text() == "D(10)" && ptlib::value("").text().empty());
    const ptl_gradient_stop stop = {0.5f, {0, 0, 1}};
    CHECK(ptlib::value(ptl_gradient_data{sizeof(ptl_gradient_data), 1, &stop}).gradient().stops[0]
              .color[2] == 1);
    const float pixel = 0.25f;
    ptl_image_data image = {};
    image.struct_size = sizeof image;
    image.format = PTL_FORMAT_GREY_F32;
    image.width = image.height = 1;
    image.pixels = &pixel;
    CHECK(ptlib::value(image).image().pixels_as<float>()[0] == pixel);
    ptl_strands_data strands = {};
    strands.struct_size = sizeof strands;
    strands.point_streams = streams;
    strands.point_stream_count = 1;
    stream.data = nullptr;
    CHECK(ptlib::value(strands).strands().strand_count == 0);
}

static void pixels(const ptlib::graph &graph, ptl_block block)
{
    ptlib::compute_options options;
    options.width = 6;
    options.height = 5;
    ptlib::image image = graph.compute(block, options);
    CHECK(image.width() == 6 && image.height() == 5 && image.pixels().size == 6 * 5 * 4);
    CHECK(image.pixels_as<float>()[29] == 0.5f);
    thrown<std::invalid_argument>([&] { image.pixels_as<unsigned char>(); });
    std::vector<unsigned char> bytes(6 * 5 * 4, 7);
    image.copy(PTL_FORMAT_RGBA8, bytes.data(), bytes.size());
    CHECK(bytes[0] == 128 && bytes[3] == 255);
    const ptlib::image other = image.retain();
    const ptlib::image moved = std::move(image);
    CHECK(moved.pixels().data == other.pixels().data && image.get() == nullptr);
    thrown<ptlib::error>([&] { image.info(); });
    options.format = PTL_FORMAT_GREY8;
    graph.compute_into(block, options, bytes.data(), bytes.size());
    CHECK(bytes[29] == 128);
    std::uint32_t rows = 0;
    const auto take = [&](const ptl_band &band) {
        rows += band.rows;
        if (rows > 4) throw enough{static_cast<int>(rows)};
        return true;
    };
    CHECK(thrown<enough>([&] { graph.compute_bands(block, take, options, 2); }).number == 5);
}

static void callbacks(ptlib::graph &graph)
{
    const ptl_block slow = graph.add("test slow");
    graph.set_int(slow, "milliseconds", 60000);
    ptlib::compute_options options;
    options.interval = std::chrono::milliseconds(1);
    int calls = 0;
    options.progress = [&](const ptl_progress &) -> bool {
        if (++calls == 2) throw enough{calls};
        return true;
    };
    CHECK(thrown<enough>([&] { graph.compute(slow, options); }).number == 2);
    calls = 0;
    unsigned char pixel[4];
    options.width = options.height = 1;
    CHECK(thrown<enough>([&] { graph.compute_into(slow, options, pixel, sizeof pixel); }).number ==
          2);
    calls = 0;
    ptlib::job job = graph.start(slow, options);
    CHECK(!job.poll());
    CHECK(thrown<enough>([&] { job.wait(); }).number == 2);
    thrown<ptlib::cancelled>([&] { job.wait(); });

    options.progress = [](const ptl_progress &) { return false; };
    thrown<ptlib::cancelled>([&] { graph.compute(slow, options); });
    options.progress = nullptr;
    ptlib::cancel cancel;
    cancel.request();
    CHECK(cancel.is_requested());
    const ptlib::cancel same = cancel.retain();
    options.stop = &same;
    thrown<ptlib::cancelled>([&] { graph.compute(slow, options); });

    options.stop = nullptr;
    job = graph.start(slow, options); // ends the one before
    CHECK(!job.wait_for(std::chrono::milliseconds(1)));
    ptl_progress progress;
    CHECK(!job.poll(&progress) && progress.fraction < 1);
}

static void catalogue(const ptlib::engine &engine)
{
    CHECK(!engine.find_block_type("no such type"));
    const auto type = engine.find_block_type("test parameters");
    CHECK(type && type->category() == "testing" && type->name() == "Test parameters");
    CHECK(type->params().size() == 5 && type->params()[4].type == PTL_PARAM_TEXT);
    CHECK(type->inputs().size() == 1 && type->outputs().size() == 2);
    CHECK(engine.block_types().size() >= 5 && type->plugin().empty() && !type->doc().empty());
}

int main()
{
    ptlib::engine_options options;
    options.base.threads = 2;
    options.read_folders = {"."};
    ptlib::engine engine(options);
    engine.set_log(PTL_LOG_WARNING, [](std::int32_t, std::string_view) { throw enough{0}; });
    catalogue(engine);

    ptlib::graph graph = engine.new_graph();
    const ptl_block block = graph.add("test parameters");
    errors(graph, block);
    values(graph);
    pixels(graph, block);
    callbacks(graph);
    graph.set_text(block, "look", "colour");
    graph.set_float(block, "level", 0.25);
    CHECK(graph.get_int(block, "look") == 1 && graph.get_text(block, "look") == "colour");
    CHECK(graph.get_float(block, "level") == 0.25);
    graph.set_block_seed(block, 5);
    graph.set_block_seed(block, std::nullopt);
    graph.reset(block, "look");
    graph.set_size(3, 2);
    CHECK(graph.info().width == 3 && graph.blocks().size() == 2 && graph.find("0") == block);

    const ptl_block end = graph.add("end");
    CHECK(!graph.source(end, 0));
    graph.connect(block, end);
    CHECK(graph.source(end, 0)->first == block && graph.main_result() == end);
    CHECK(graph.id(block) == "0" && graph.type_id(end) == "end" && graph.block_seed(end) == 0);
    graph.disconnect(end, 0);
    graph.remove(end);

    ptlib::graph copy = graph.clone();
    copy.remove(block);
    CHECK(graph.type(block).id() == "test parameters");
    const ptlib::graph again = engine.load(graph.save());
    CHECK(again.save() == graph.save() && again.warnings().empty() && again.main_result() == 0);
    const auto broken = thrown<ptlib::error>([&] { engine.load("<texturegraph width=\"x\"/>"); });
    CHECK(!broken.faults().empty() && broken.faults()[0].line == 1);
    int files = 0;
    ptlib::engine scanning = engine.retain();
    scanning.scan_plugins([&](const ptl_scan_report &) { return ++files > 0; },
                          std::getenv("PTLIB_TEST_PLUGINS"));
    CHECK(files == 2 && engine.find_block_type("ptlib-test.invert"));
    const auto stop = [&] {
        const auto refuse = [&](const ptl_scan_report &) {
            if (files > 0) {
                throw std::runtime_error("no more files");
            }
            return true;
        };
        scanning.scan_plugins(refuse, std::getenv("PTLIB_TEST_PLUGINS"));
    };
    CHECK(thrown<std::runtime_error>(stop).what() == std::string("no more files"));
    thrown<ptlib::error>([&] { scanning.load_plugin("nowhere.ptplugin.so"); });
    const ptlib::engine same = engine.retain();
    engine.set_log(PTL_LOG_WARNING, nullptr);
    CHECK(ptlib::version() == ptl_version_string());
    return 0;
}
