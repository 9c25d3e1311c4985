// Builds a graph by hand, computes it, and saves the graph and its picture.
//
// Bump noise becomes the red channel of the picture, a Voronoi diagram the green one, and that
// diagram sent through a circle transform the blue one.
//
// SPDX-License-Identifier: MIT OR Apache-2.0
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>

#include <ptlib/ptlib.hpp>

static ptl_block build(ptlib::graph &graph)
{
    graph.set_size(256, 256);
    const ptl_block bumps = graph.add("bump noise");
    graph.set_float(bumps, "bump size from", 0.3);
    const ptl_block cells = graph.add("voronoi diagram");
    graph.set_int(cells, "number of points", 30);
    const ptl_block circles = graph.add("circle transform");
    graph.connect(cells, circles);

    const ptl_block colours = graph.add("mix channels");
    graph.connect(bumps, colours, 0);
    graph.connect(cells, colours, 1);
    graph.connect(circles, colours, 2);
    const ptl_block end = graph.add("end");
    graph.connect(colours, end);
    return end;
}

int main()
try {
    const ptlib::engine engine;
    ptlib::graph graph = engine.new_graph();
    const ptl_block end = build(graph);

    std::ofstream file("build_graph.xml", std::ios::binary);
    file.exceptions(std::ios::failbit | std::ios::badbit);
    file << graph.save();

    graph.compute(end).save("build_graph.png");
    std::cout << "build_graph.xml and build_graph.png\n";
    return EXIT_SUCCESS;
} catch (const std::exception &error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
}
