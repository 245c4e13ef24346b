def make(material_of):
    pass
