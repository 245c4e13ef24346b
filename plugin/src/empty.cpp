// Stands in until a part has files.
