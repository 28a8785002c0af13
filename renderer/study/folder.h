// The folder that a study writes to: pictures, tables, plots and the page, each kept until what it shows
// changes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/film/film.h"
#include "renderer/scene/scene.h"

namespace rondure {

class StudyFolder {
 public:
  // Made if it is not there. Throws std::runtime_error naming it.
  explicit StudyFolder(std::string path);

  std::string path(const std::string& name) const { return path_ + "/" + name; }
  void write(const std::string& name, const std::string& text) const;
  // The whole of a file; empty when there is none.
  std::string read(const std::string& name) const;

  // The file's text if it was written for the same key, else `make`'s, written under the name. What the text
  // depends on must be in the key: work that is interrupted goes on from the files that are there.
  std::string kept(const std::string& name, const std::string& key,
                   const std::function<std::string()>& make) const;

 private:
  std::string path_;

  std::string key_name(const std::string& name) const { return name + ".key"; }
};

// For an HTML page that needs no other file.
std::string base64(const std::string& bytes);
std::string html_escaped(const std::string& text);

}  // namespace rondure
