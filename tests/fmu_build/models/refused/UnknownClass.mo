model UnknownClass "A class that does not exist"
  NoSuchClass part; // here
end UnknownClass;
