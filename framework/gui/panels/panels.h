// SPDX-License-Identifier: MIT
// The panels of the workbench, a file each. Every one draws itself into the area at hand and
// changes the bench's document or state; none waits for anything.
#pragma once

#include "framework/gui/bench.h"

namespace kaustik::gui {

void drawShown(Bench& bench);   // one line: whether what is shown is what was asked for
void drawPasses(Bench& bench);  // what runs, what it costs, on and off
void drawPassDetail(Bench& bench, const graph::PassRecord& pass);  // what it reads and writes
void drawGraph(Bench& bench);        // the passes as a picture, stages in columns
void drawTimeChart(Bench& bench);    // the newest frames as stacks of their passes
void drawTechnique(Bench& bench);    // technique, nodes, and a second variant next to the first
void drawParameters(Bench& bench);   // of the nodes in use, from their declarations
void drawImage(Bench& bench);        // which texture, and how its values become colours
void drawTextureList(Bench& bench);  // of the graph, to choose one of
void drawPicture(Bench& bench);      // the picture itself, with what the hand does on it
void drawError(Bench& bench);        // how wrong the frame is, and where the reference comes from
void drawTradeOff(Bench& bench);     // error against time of the session's settings
void drawStudy(Bench& bench);        // settings to vary, and what their runs have found
void drawCompare(Bench& bench);      // variants that were kept, and how they differ
void keepVariant(Bench& bench);      // what is shown, with its settings, pictures, times and errors
void drawScene(Bench& bench);        // scene, camera, lights, water, time
void drawRecord(Bench& bench);       // screenshots, sequences, reports, experiments
void saveExperiment(Bench& bench);   // into the folder of recordings, under a new name
void drawHelp(Bench& bench);         // keys

}  // namespace kaustik::gui
