#pragma once

#include <boost/property_tree/xml_parser.hpp>
#include <sstream>
#include <string>

namespace ursula {

inline boost::property_tree::ptree parsedXml(const std::string& xml) {
  std::istringstream stream(xml);
  boost::property_tree::ptree tree;
  read_xml(stream, tree);
  return tree;
}

inline std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

}  // namespace ursula
