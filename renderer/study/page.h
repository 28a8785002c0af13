// The parts of a study's page: HTML that needs no other file.
#pragma once

#include <string>
#include <vector>

namespace rondure {

// Head, title and the command that makes the page again; `body` is HTML.
std::string html_page(const std::string& title, const std::string& command, const std::string& body);

// Cells are HTML. The first row heads the columns.
std::string html_table(const std::vector<std::vector<std::string>>& rows);

std::string html_figure(const std::string& content, const std::string& caption);
// A picture by its PNG bytes.
std::string html_picture(const std::string& png, const std::string& alt);

// "3.2e-09"; "-" for NaN.
std::string number_text(double x, int digits = 3);

}  // namespace rondure
