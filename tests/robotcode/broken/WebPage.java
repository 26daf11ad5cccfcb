<!DOCTYPE html>
<html><head><title>404</title></head>
<body><p>The page you were looking for is not here.</p></body></html>
