// Renders a graph file into a picture:  render [GRAPH [PICTURE [SIZE]]]
//
// Build it with:  c++ -std=c++17 render.cpp -o render $(pkg-config --cflags --libs ptlib)
//
// SPDX-License-Identifier: MIT OR Apache-2.0
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>

#include <ptlib/ptlib.hpp>

// The graph to render if none is named.
static std::string usual_graph()
{
    const char *examples = std::getenv("PTLIB_EXAMPLES");
    return std::string(examples ? examples : "examples") + "/graphs/stained-glass.xml";
}

int main(int argc, char **argv)
try {
    const std::string file = argc > 1 ? argv[1] : usual_graph();
    const std::string picture = argc > 2 ? argv[2] : "render.png";
    ptlib::compute_options options;
    options.format = PTL_FORMAT_RGB8;
    if (argc > 3) {
        options.width = options.height = static_cast<std::uint32_t>(std::stoul(argv[3]));
    }

    const ptlib::engine engine;
    const ptlib::graph graph = engine.load_file(file);
    for (const ptlib::fault &warning : graph.warnings()) {
        std::cerr << "warning: " << warning.message << '\n';
    }
    graph.compute(graph.main_result(), options).save(picture);
    std::cout << picture << '\n';
    return EXIT_SUCCESS;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
