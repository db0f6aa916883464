UPDATE sweep SET points = 9223372036854775807, keys = '[]'; INSERT INTO point VALUES(9223372036854775806, '{}', 'singular', -0.0, 'leg 6');
